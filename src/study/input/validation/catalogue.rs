//! Catalogues of absorbers.

use super::absorbers::DesignSpec;
use super::family::materials;
use super::material_states::{Known, MaterialSpec, geometry};
use super::named::{station, table};
use super::rooms::made;
use crate::absorber::construction::shape;
use crate::absorber::{Absorber, Declaration, Geometry, Material, Mounted, TYPES, WithMaterial};
use crate::drivetrain::Chain;
use crate::input::error::{At, Check};
use crate::input::letters::fault;
use crate::input::schema::bounds::{BEST, TOLERANCE};
use crate::input::schema::catalogue::RawCatalogue;
use crate::input::schema::study::RawStudy;
use crate::input::tables::{CatalogueRow, MadeWith, catalogue};
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

pub(super) fn resolve(
    check: &mut Check,
    study: &RawStudy,
    (chain, folder): (&Chain, &Path),
    given: &[DesignSpec],
    known: Known,
) -> Vec<CatalogueSpec> {
    let mut names: HashSet<String> = given.iter().map(|d| d.name.clone()).collect();
    let mut list = Vec::new();
    for raw in &study.catalogue {
        let best = check.whole(&raw.best, &BEST) as usize;
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
        let materials = materials_of_rows(check, raw, (&rows, geometry), known);
        if rows.len() > MOST {
            check.wrong(&raw.file, format!("found {} absorbers, expected at most {MOST}", rows.len()));
        }
        let has = |key: &str| rows.iter().any(|r| r.declaration.index(key).is_some());
        for (key, at, _) in shares.iter().filter(|s| !has(s.0)) {
            check.wrong(*at, format!("found `{key}` to be free, which no absorber of the catalogue has"));
        }
        let free: Vec<(&'static str, f64)> = shares.iter().map(|s| (s.0, s.2)).collect();
        let plain = Arc::new(Material { geometry, ..Material::default() });
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
            if let Some(shape) = shape(row.declaration) {
                made(check, &raw.file, (shape, &row.values), Some(&row.name));
            }
            let law = (row.declaration.build)(&row.values);
            let absorber = Absorber::Ring(WithMaterial::of(law, materials.get(row.declaration.name).unwrap_or(&plain)));
            designs.push(DesignSpec {
                name: row.name,
                absorbers: vec![Mounted { hub_inertia: row.hub_inertia, ..Mounted::on_station(on, absorber) }],
            });
        }
        list.push(CatalogueSpec { file: raw.file.get_ref().clone(), best, designs, free });
    }
    list
}

/// Materials of the rows by the names of the types that have one.
fn materials_of_rows(
    check: &mut Check,
    raw: &RawCatalogue,
    (rows, geometry): (&[CatalogueRow], Option<Geometry>),
    known: Known,
) -> BTreeMap<&'static str, Arc<Material>> {
    let types: BTreeMap<&str, &'static Declaration> = rows.iter().map(|r| (r.declaration.name, r.declaration)).collect();
    let types: Vec<&'static Declaration> = types.into_values().collect();
    for material in raw.material.values().filter(|m| !m.get_ref().properties.is_empty()) {
        check.wrong(material, "found properties of the material of a catalogue, expected them among the columns of its table");
    }
    let of_type = |(declaration, spec): (&'static Declaration, MaterialSpec)| {
        (declaration.name, Arc::new(spec.of_type(declaration, spec.choices.first(), known.temperatures)))
    };
    materials(check, &raw.material, (&types, geometry), known).into_iter().map(of_type).collect()
}

/// Keys with their places and shares.
fn shares<'r>(check: &mut Check, raw: &'r BTreeMap<String, At<f64>>) -> Vec<(&'static str, &'r At<f64>, f64)> {
    let mut list = Vec::new();
    for (key, share) in raw {
        let Some(known) = TYPES.iter().flat_map(|t| t.parameters).map(|p| p.key).find(|known| known == key) else {
            check.wrong(share, format!("found `{key}` to be free, expected the key of a parameter of a type"));
            continue;
        };
        list.push((known, share, check.within(share, &TOLERANCE)));
    }
    list
}
