//! The worst of the locations of every fillet (its webs, and the shafts on both sides of a crankpin) at a speed.

use super::{Margin, Torque, Used};

/// A fillet by one criterion.
#[derive(Debug, Clone)]
pub(crate) struct Fillet {
    /// Index of the criterion.
    pub criterion: usize,
    /// Its name.
    pub name: String,
    /// Its locations.
    locations: Vec<usize>,
}

impl Margin {
    /// All fillets: by criterion, then as the locations are listed.
    pub(crate) fn fillets(&self) -> Vec<Fillet> {
        let mut list: Vec<Fillet> = Vec::new();
        for criterion in 0..self.criteria.len() {
            for (i, location) in self.locations.iter().enumerate().filter(|(i, _)| self.judges(criterion, *i)) {
                match list.iter_mut().find(|f| f.criterion == criterion && f.name == location.name) {
                    Some(fillet) => fillet.locations.push(i),
                    None => list.push(Fillet { criterion, name: location.name.clone(), locations: vec![i] }),
                }
            }
        }
        list
    }

    /// The location of each fillet that is used most, under the torques of all shafts at a speed. Of a multiaxial criterion only those are searched whose bound is above what another one
    /// uses.
    pub(crate) fn worst_of_each(&self, fillets: &[Fillet], speed_rpm: f64, torques: &[Torque]) -> Vec<Used> {
        let mut whole: Vec<Option<Vec<f64>>> = vec![None; torques.len()];
        let mut shares: Vec<Option<Vec<f64>>> = vec![None; self.locations.len()];
        let larger = |most: Option<Used>, used: Used| match most {
            Some(most) if (most.value, used.location) >= (used.value, most.location) => Some(most),
            _ => Some(used),
        };
        let worst = |fillet: &Fillet| -> Option<Used> {
            let Fillet { criterion, locations, .. } = fillet;
            if !self.is_multiaxial(*criterion) {
                let used = |i: &usize| self.used(*criterion, *i, speed_rpm, &torques[self.locations[*i].shaft]);
                return locations.iter().map(used).fold(None, larger);
            }
            let bound = |i: &usize| self.bound_of(*criterion, *i, speed_rpm, &torques[self.locations[*i].shaft]);
            let mut able: Vec<(f64, usize)> = locations.iter().map(|i| (bound(i), *i)).collect();
            able.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            let mut most: Option<Used> = None;
            for (bound, i) in able {
                if most.is_some_and(|m| bound < m.value) {
                    break;
                }
                let shaft = self.locations[i].shaft;
                let own = shares[i].get_or_insert_with(|| {
                    let torque = whole[shaft].get_or_insert_with(|| self.whole_torque(shaft, speed_rpm, &torques[shaft]));
                    self.shares_of(i, speed_rpm, torque)
                });
                most = larger(most, self.used_as(*criterion, i, own));
            }
            most
        };
        fillets.iter().filter_map(worst).collect()
    }
}
