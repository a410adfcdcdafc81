//! Catalogues of absorbers.

use super::absorbers::DesignSpec;
use super::named::{station, table};
use crate::absorber::{Absorber, Mounted};
use crate::drivetrain::Chain;
use crate::input::error::Check;
use crate::input::schema::study::RawStudy;
use crate::input::tables::catalogue;
use std::collections::HashSet;
use std::path::Path;

/// Absorbers of a catalogue as designs of one each.
#[derive(Debug, Clone, PartialEq)]
pub struct CatalogueSpec {
    /// The file, as the study names it.
    pub file: String,
    /// How many of the best are reported like given designs.
    pub best: usize,
    /// All of them.
    pub designs: Vec<DesignSpec>,
}

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
        let (Some(on), Some(rows)) = (station(check, chain, &raw.on.station), table(check, &raw.file, folder, catalogue)) else { continue };
        if rows.len() > MOST {
            check.wrong(&raw.file, format!("found {} absorbers, expected at most {MOST}", rows.len()));
        }
        let mut designs = Vec::new();
        for row in rows {
            if !names.insert(row.name.clone()) {
                check.wrong(&raw.file, format!("found `{}` in it, which another design is called, expected different names", row.name));
            }
            let absorber = Absorber::Ring((row.declaration.build)(&row.values));
            designs.push(DesignSpec { name: row.name, absorbers: vec![Mounted::on_station(on, absorber)] });
        }
        list.push(CatalogueSpec { file: raw.file.get_ref().clone(), best, designs });
    }
    list
}
