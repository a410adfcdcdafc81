//! Whether a damper by its dimensions has room for what it is made of.

use crate::absorber::construction::{Unfit, shape};
use crate::absorber::{Declaration, Parameter, Shape};
use crate::input::error::{At, Check};
use crate::input::schema::absorber::RawOptimised;
use crate::input::schema::range::RawRange;
use crate::units::M_PER_MM;

/// A parameter by its key with its bounds.
type Bounds = (&'static str, (f64, f64));
/// A dimension by its key with its steps.
type Steps = (&'static str, Vec<f64>);

/// Whether each type by its dimensions has room for what it is made of, wherever its bounds lie: there is least where the outer diameter is least and all else is most.
pub(super) fn rooms(
    check: &mut Check,
    raw: &RawOptimised,
    (types, largest_ring): (&[&'static Declaration], f64),
    (bounds, steps): (&[Bounds], &[Steps]),
) {
    for shape in types.iter().filter_map(|t| shape(t)) {
        let end = |p: &Parameter, i: usize| -> Option<f64> {
            let stepped = || {
                steps
                    .iter()
                    .find(|s| s.0 == p.key)
                    .map(|s| s.1.iter().fold((f64::INFINITY, 0.0), |m: (f64, f64), x| (m.0.min(*x), m.1.max(*x))))
            };
            let (low, high) = bounds.iter().find(|b| b.0 == p.key).map(|b| b.1).or_else(stepped)?;
            Some(if shape.tightest_at_least(i) { low } else { high })
        };
        let dimensions = shape.drawn();
        let Some(corner) = dimensions.iter().enumerate().skip(1).map(|(i, p)| end(p, i)).collect::<Option<Vec<f64>>>() else { continue };
        let values: Vec<f64> = std::iter::once(largest_ring).chain(corner).collect();
        let at = raw.bounds.iter().find(|b| b.0 == dimensions[1].key).and_then(|b| first_value(&b.1));
        if let (Some(at), Some(unfit)) = (at, shape.unfit(&values)) {
            let words = format!("found bounds of `{}` that leave no room inside: {}", shape.declaration.name, told(unfit, "would be"));
            check.wrong_with_help(at, format!("{words} wherever the bounds lie"), help(unfit));
        }
    }
}

/// Whether a given one can be made; `at`: its outer diameter, or the file that it stands in, then by its name.
pub(super) fn made<T>(check: &mut Check, at: &At<T>, (shape, values): (&Shape, &[f64]), name: Option<&str>) {
    if let Some(unfit) = shape.unfit(values) {
        let whose = name.map_or_else(String::new, |name| format!(" in `{name}`"));
        let words = format!("found dimensions of `{}`{whose} that leave no room inside: {}", shape.declaration.name, told(unfit, "is"));
        check.wrong_with_help(at, words, help(unfit));
    }
}

/// What has no room, and what was expected.
fn told(unfit: Unfit, is: &str) -> String {
    let mm = |x: f64| x / M_PER_MM;
    match unfit {
        Unfit::Bore(bore) => format!("its bore {is} {:.1} mm, expected it above zero", mm(bore)),
        Unfit::Springs { taken, there } => {
            format!(
                "the width of its springs together {is} {:.1} mm, expected less than the {:.1} mm of their circle",
                mm(taken),
                mm(there)
            )
        }
        Unfit::Path { path, centre } => {
            format!("the radius of the path {is} {:.1} mm, expected less than the {:.1} mm of the centre of a mass", mm(path), mm(centre))
        }
    }
}

fn help(unfit: Unfit) -> &'static str {
    match unfit {
        Unfit::Bore(_) => "half the least outer diameter has to be more than all walls, gaps, rubber and springs at their most",
        Unfit::Springs { .. } => {
            "leaves count with their thickness, coil springs with their length where they are pressed flat, two end coils with it"
        }
        Unfit::Path { .. } => "a path of the radius R0/(n² + 1) is tuned to an order n, R0 being that of the centre",
    }
}

/// Where a range begins in the file.
pub(super) fn first_value(range: &RawRange) -> Option<&At<f64>> {
    match range {
        RawRange::Fixed(v) => Some(v),
        RawRange::Between(list) | RawRange::Each(list) => list.get_ref().first(),
    }
}
