//! Critical planes that \[Minucci 2010\] prints, by both readings of his angles. His eq. (4.1) has phi from the axis of the crank and theta round it, as ours; his text has theta as colatitude.
//!
//! Where the plane of the largest shear amplitude is that of Dang Van, his search may print n for one and -n for the other. The reading by which more of his pairs are one plane is the likelier one
//! of his program.

use super::{Entry, Kind, Role, Uncertainty};
use crate::fatigue::multiaxial::Plane;
use crate::input::Published;
use crate::input::published::{PublishedPlanes, PublishedPoint};
use crate::units::{DEG_PER_RAD, RAD_PER_DEG};

/// His grid.
const GRID: f64 = 15.0 * RAD_PER_DEG;
/// Two normals are one plane where their product is one to this.
const SAME: f64 = 1e-9;

/// How the angles are read.
type Reading = fn([f64; 2]) -> Plane;

/// Eq. (4.1): phi from the axis of the crank, theta round it.
fn by_equation([theta, phi]: [f64; 2]) -> Plane {
    Plane { theta, phi }
}

/// The text of section 2: theta from the axis of the crank, phi round it.
fn by_text([theta, phi]: [f64; 2]) -> Plane {
    Plane { theta: phi, phi: theta }
}

/// All printed angles, on the grid or not, and how many pairs of planes are one by each reading.
pub fn entries(published: &Published) -> Vec<Entry> {
    let mut list = Vec::new();
    for row in &published.planes {
        list.extend(angles(&row.at, "plane of the largest shear amplitude", row.shear));
        list.extend(angles(&row.at, "plane by Dang Van", row.dang_van));
    }
    let readings: [(&str, Reading); 2] = [("by eq. (4.1)", by_equation), ("with theta as colatitude", by_text)];
    list.extend(readings.into_iter().filter(|_| !published.planes.is_empty()).map(|(words, reading)| one_plane(published, words, reading)));
    list
}

fn entry(
    (table, design): (&str, String),
    quantity: String,
    (kind, unit): (Kind, &str),
    values: (Option<f64>, Option<f64>),
    role: Role,
    note: String,
) -> Entry {
    Entry {
        table: table.into(),
        design,
        quantity,
        kind,
        unit: unit.into(),
        published: values.0,
        computed: values.1,
        uncertainty: Uncertainty::default(),
        role,
        note,
    }
}

fn angles(at: &PublishedPoint, what: &str, printed: [f64; 2]) -> [Entry; 2] {
    let normal = |reading: Reading| reading(printed).normal().map(|x| format!("{x:.3}")).join(", ");
    let note = format!(
        "normal ({}) by eq. (4.1), ({}) with theta as colatitude; z is the axis of the crank",
        normal(by_equation),
        normal(by_text)
    );
    let speed = if at.speed.is_empty() { String::new() } else { format!(" at {} rpm", at.speed) };
    let on_grid = |angle: f64| (angle / GRID - (angle / GRID).round()).abs() < SAME;
    let of = |name: &str, angle: f64| {
        let (role, note) =
            if on_grid(angle) { (Role::Given, note.clone()) } else { (Role::Erratum, format!("not on the grid of 15 degrees; {note}")) };
        let design = format!("{} {}{speed}", at.crank, at.point);
        entry((&at.table, design), format!("{what}, {name}"), (Kind::PlaneAngle, "deg"), (Some(angle * DEG_PER_RAD), None), role, note)
    };
    [of("theta", printed[0]), of("phi", printed[1])]
}

/// At how many points the two printed planes are one.
fn one_plane(published: &Published, words: &str, reading: Reading) -> Entry {
    let same = |row: &&PublishedPlanes| {
        let [a, b] = [row.shear, row.dang_van].map(|angles| reading(angles).normal());
        let product: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
        (product.abs() - 1.0).abs() < SAME
    };
    let (all, found) = (published.planes.len(), published.planes.iter().filter(same).count());
    let quantity = format!("points whose two printed planes are one {words}");
    let note = format!("of {all} points; the reading with more of them is the likelier one of the program behind the tables");
    let mut tables: Vec<&str> = published.planes.iter().map(|row| row.at.table.as_str()).collect();
    tables.dedup();
    entry((&tables.join(", "), String::new()), quantity, (Kind::Other, "-"), (None, Some(found as f64)), Role::Recomputed, note)
}
