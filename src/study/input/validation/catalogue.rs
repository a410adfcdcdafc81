//! Catalogues of absorbers.

use super::absorbers::DesignSpec;
use super::material_states::geometry;
use super::named::{station, table};
use crate::absorber::{Absorber, Material, Mounted, TYPES, WithMaterial};
use crate::drivetrain::Chain;
use crate::input::error::{At, Check};
use crate::input::letters::fault;
use crate::input::schema::study::RawStudy;
use crate::input::tables::{MadeWith, catalogue};
use std::collections::{BTreeMap, HashSet};
use std::path::Path;
use std::sync::Arc;

/// Absorbers of a catalogue as designs of one each.
#[derive(Debug, Clone, PartialEq)]
pub struct CatalogueSpec {
    /// The file, as the study names it.
    pub file: String,
    /// How many of the best are reported like given designs.
    pub best: usize,
    /// All of them.
    pub designs: Vec<DesignSpec>,
    /// Shares by which parameters may differ from the catalogue's, by their keys: each of the best is tuned anew within them.
    pub free: Vec<(&'static str, f64)>,
}

/// Added to the name of an absorber that is tuned anew.
#[doc(hidden)]
pub const RETUNED: &str = "_retuned";
/// Most rows of all catalogues together.
const MOST: usize = 100_000;

pub(super) fn resolve(check: &mut Check, study: &RawStudy, chain: &Chain, folder: &Path, given: &[DesignSpec]) -> Vec<CatalogueSpec> {
    let mut names: HashSet<String> = given.iter().map(|d| d.name.clone()).collect();
    let mut list = Vec::new();
    for raw in &study.catalogue {
        let best = usize::try_from(*raw.best.get_ref()).ok().filter(|n| (1..=100).contains(n)).unwrap_or_else(|| {
            check.wrong(&raw.best, format!("found {}, expected how many of the best are wanted, from 1 to 100", raw.best.get_ref()));
            1
        });
        // the table of the run names it
        if let Some(fault) = fault(raw.file.get_ref()) {
            check.wrong(&raw.file, format!("found {fault}"));
        }
        let shares = shares(check, &raw.free);
        let geometry = raw.geometry.as_ref().and_then(|g| geometry(check, g));
        let ring_inertia = raw.ring_inertia_kg_m2.as_ref().map(|j| check.positive(j));
        let with = MadeWith { ring_inertia, factor: geometry.map(|g| g.factor()) };
        let read = |path: &Path| catalogue(path, with);
        let (Some(on), Some(rows)) = (station(check, chain, &raw.on.station), table(check, &raw.file, folder, read)) else { continue };
        let material = Arc::new(Material { geometry, ..Material::default() });
        if rows.len() > MOST {
            check.wrong(&raw.file, format!("found {} absorbers, expected at most {MOST}", rows.len()));
        }
        let has = |key: &str| rows.iter().any(|r| r.declaration.index(key).is_some());
        for (key, at, _) in shares.iter().filter(|s| !has(s.0)) {
            check.wrong(*at, format!("found `{key}` to be free, which no absorber of the catalogue has"));
        }
        let free: Vec<(&'static str, f64)> = shares.iter().map(|s| (s.0, s.2)).collect();
        let mut designs = Vec::new();
        for row in rows {
            let again = (!free.is_empty()).then(|| format!("{}{RETUNED}", row.name));
            for name in std::iter::once(row.name.clone()).chain(again) {
                if !names.insert(name.clone()) {
                    check.wrong(
                        &raw.file,
                        format!("found `{}` in it, while another design is called `{name}`, expected different names", row.name),
                    );
                }
            }
            let absorber = Absorber::Ring(WithMaterial::of((row.declaration.build)(&row.values), &material));
            designs.push(DesignSpec { name: row.name, absorbers: vec![Mounted::on_station(on, absorber)] });
        }
        list.push(CatalogueSpec { file: raw.file.get_ref().clone(), best, designs, free });
    }
    list
}

/// Keys with their places and shares.
fn shares<'r>(check: &mut Check, raw: &'r BTreeMap<String, At<f64>>) -> Vec<(&'static str, &'r At<f64>, f64)> {
    let mut list = Vec::new();
    for (key, share) in raw {
        let Some(known) = TYPES.iter().flat_map(|t| t.parameters).map(|p| p.key).find(|known| known == key) else {
            check.wrong(share, format!("found `{key}` to be free, expected the key of a parameter of a type"));
            continue;
        };
        list.push((known, share, check.within(share, 1e-6..=0.9, "a share from 1e-6 to 0.9: 0.1 is 10 % more or less")));
    }
    list
}
