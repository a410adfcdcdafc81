//! A ring in silicone oil in its housing, which is bolted to the crank: oil at both faces, at the rim and at the bore of the ring.
//! The oil round the edges of the ring is left out: with gaps of 0.5 mm at a ring of 40 by 31 mm B is 0.9 % too small by finite elements.

use super::law::build;
use super::shape::{M_PER_MM, OUTER_DIAMETER, RING_DENSITY, RING_WALL, Shape, annulus, dimension, polar, sleeve_factor};
use crate::absorber::carreau::{FLOW_INDEX, TRANSITION};
use crate::absorber::law::Declaration;
use crate::absorber::maxwell::RELAXATION_TIME;
use crate::absorber::parameter::{Follows, Parameter, RING_INERTIA, Range, of_material};
use crate::absorber::parts::{MOST, Medium, Number, Parts};
use crate::numerics::dual::Dual;

/// A ring in silicone oil in its housing.
pub static HOUSING: Declaration = Declaration {
    name: "housing",
    about: "A ring in silicone oil in its housing, by its dimensions.",
    parameters: &[
        RING_INERTIA,
        Parameter { about: "Outer diameter of the housing.", ..OUTER_DIAMETER },
        dimension(("housing_wall_mm", "s/mm", "Thickness of the housing's walls."), Range::Positive, (|_| (4.5, 5.5), |_| 5.0)),
        RING_WALL,
        dimension(
            ("radial_gap_mm", "gap_r/mm", "Gap at the rim and at the bore of the ring."),
            Range::Positive,
            (|_| (0.45, 0.55), |_| 0.5),
        ),
        dimension(("axial_gap_mm", "gap_a/mm", "Gap at each face of the ring."), Range::Positive, (|_| (0.36, 0.44), |_| 0.4)),
        RING_DENSITY,
        dimension(
            ("housing_density_kg_m3", "rho_h/kg/m³", "Density of the housing: 7850 of steel, 7200 of cast iron."),
            Range::Within(500.0, 25_000.0),
            (|_| (7065.0, 8635.0), |_| 7850.0),
        ),
        Parameter {
            follows: Follows::Factor,
            ..of_material(
                ("viscosity_pa_s", "eta/Pa s", "Viscosity of the oil at low frequency."),
                Range::Positive,
                |_| (1e-3, 2e3),
                |_| 1.0,
            )
        },
        Parameter { range: Range::Positive, ..RELAXATION_TIME },
        TRANSITION,
        FLOW_INDEX,
    ],
    build: |v| build(&SHAPE, v),
    closed_forms: &[],
};

pub(super) static SHAPE: Shape = Shape::sheared(&HOUSING, Medium::Oil, 8, parts);

fn parts(d: &[Number; MOST]) -> Parts<Number> {
    let [inertia, diameter, wall, ring_wall, radial, axial, density, housing_density, ..] = *d;
    let outside = diameter * (0.5 * M_PER_MM);
    let (wall, radial, axial) = (wall * M_PER_MM, radial * M_PER_MM, axial * M_PER_MM);
    let rim = outside - wall;
    let outer = rim - radial;
    let inner = outer - ring_wall * M_PER_MM;
    let bore = inner - radial;
    let inside = bore - wall;
    let ring_width = inertia / (density * polar(inner, outer));
    let chamber = ring_width + axial * 2.0;
    let at_rim = rim.powi(2) / (rim.powi(2) - outer.powi(2)) * 2.0;
    let at_faces = outer / axial;
    // two faces, rim and bore, as far as each reaches
    let of_housing = |section: &dyn Fn(Number, Number) -> Number| {
        (section(inside, outside) * wall * 2.0 + (section(rim, outside) + section(inside, bore)) * chamber) * housing_density
    };
    Parts {
        factor: polar(inner, outer) / axial * 2.0 + sleeve_factor(outer, rim, ring_width) + sleeve_factor(bore, inner, ring_width),
        strain_per_twist: if at_rim.value > at_faces.value { at_rim } else { at_faces },
        stress_per_twist: Dual::constant(0.0),
        hub_inertia: of_housing(&polar),
        ring_mass: density * annulus(inner, outer) * ring_width,
        hub_mass: of_housing(&annulus),
        element_volume: annulus(inner, outer) * axial * 2.0 + (annulus(outer, rim) + annulus(bore, inner)) * chamber,
        outer_diameter: outside * 2.0,
        width: chamber + wall * 2.0,
        bore: inside * 2.0,
        ring: [inner, outer],
        ring_width,
        element_length: radial,
        radius: Dual::constant(0.0),
    }
}
