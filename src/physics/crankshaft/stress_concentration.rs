//! Stress concentration in the fillets of a crank and at its oil bore, as factors of nominal stress.
//!
//! \[IACS UR M53\] section 3 and, as the same formulas of the FVV (Eberhard 1973) with an older one for torsion, appendix A of \[Villalva 2014\]. The printed
//! appendix has `1,1495e` for 1.1495 w, lacks a parenthesis before s², starts f_F(d_H) with 1.0012 for 1.0022, calls R0/Dc the overlap s, which is
//! ((Dc + Dj)/2 - R0)/Dc, and exchanges the bores: d_H is that of the crankpin (Hubzapfen), d_G that of the journal (Grundzapfen). Bending factors belong to the section of the web, B W²/6, whatever the cylinder.

use crate::numerics::elementary::Elementary;

/// Dimensions that the factors depend on, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Geometry {
    /// D.
    pub pin_diameter: f64,
    /// D_G.
    pub journal_diameter: f64,
    /// S; negative without overlap.
    pub overlap: f64,
    /// W.
    pub web_thickness: f64,
    /// B.
    pub web_breadth: f64,
    /// R_H.
    pub pin_fillet: f64,
    /// R_G.
    pub journal_fillet: f64,
    /// D_BH.
    pub pin_bore: f64,
    /// D_BG.
    pub journal_bore: f64,
    /// T_H.
    pub pin_recess: f64,
    /// T_G.
    pub journal_recess: f64,
    /// D_O.
    pub oil_bore: Option<f64>,
}

/// Factors of nominal bending, radial force and torsion at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Factors {
    /// Of nominal bending stress.
    pub bending: f64,
    /// Of nominal compressive stress of the web by the radial force; journal fillets only.
    pub radial: f64,
    /// Of nominal torsional stress.
    pub torsion: f64,
}

/// Factors of all places of a crank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Concentration {
    /// alpha_B and alpha_T.
    pub crankpin: Factors,
    /// beta_B, beta_Q and beta_T.
    pub journal: Factors,
    /// gamma_B and gamma_T.
    pub oil_bore: Option<Factors>,
}

/// Which formulas.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Formulas {
    /// \[IACS UR M53\] section 3.
    IacsM53,
    /// Appendix A of \[Villalva 2014\]: as before, but 0.923 for 0.8 w^-0.145 in torsion, and no radial force.
    Fvv1973,
}

/// A dimension outside the range of the formulas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutOfRange {
    /// What it is.
    pub name: &'static str,
    /// Its value, relative to the diameter of the crankpin.
    pub value: f64,
    /// Lowest and highest value.
    pub range: (f64, f64),
}

/// Below this overlap the formulas are evaluated at it \[IACS UR M53\] section 3.1.
const LEAST_OVERLAP: f64 = -0.5;

impl Geometry {
    fn relative(&self, x: f64) -> f64 {
        x / self.pin_diameter
    }

    /// Dimensions outside the ranges that \[IACS UR M53\] section 3.1 gives; empty where the factors are valid.
    pub fn out_of_range(&self) -> Vec<OutOfRange> {
        let all = [
            ("overlap", self.overlap, (f64::NEG_INFINITY, 0.5)),
            ("web thickness", self.web_thickness, (0.2, 0.8)),
            ("web breadth", self.web_breadth, (1.1, 2.2)),
            ("crankpin fillet", self.pin_fillet, (0.03, 0.13)),
            ("journal fillet", self.journal_fillet, (0.03, 0.13)),
            ("crankpin bore", self.pin_bore, (0.0, 0.8)),
            ("journal bore", self.journal_bore, (0.0, 0.8)),
            ("oil bore", self.oil_bore.unwrap_or(0.0), (0.0, 0.2)),
        ];
        let relative = all.map(|(name, x, range)| OutOfRange { name, value: self.relative(x), range });
        relative.into_iter().filter(|d| !(d.range.0..=d.range.1).contains(&d.value)).collect()
    }
}

/// c0 + c1 x + c2 x² + ...
fn polynomial(x: f64, c: &[f64]) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

impl Concentration {
    /// The factors; valid where [`Geometry::out_of_range`] is empty.
    pub fn new(geometry: &Geometry, formulas: Formulas) -> Self {
        let g = geometry;
        let s = g.relative(g.overlap);
        let limited = s.max(LEAST_OVERLAP);
        let (w, b) = (g.relative(g.web_thickness), g.relative(g.web_breadth));
        let (d_pin, d_journal) = (g.relative(g.pin_bore), g.relative(g.journal_bore));
        let (r_pin, r_journal) = (g.relative(g.pin_fillet), g.relative(g.journal_fillet));
        // without recess one; what would lower the factors does not count
        let recess = (1.0 + g.relative(g.pin_recess + g.journal_recess) * (1.8 + 3.2 * s)).max(1.0);
        let pin_bending = 2.6914
            * pin_overlap(limited, w)
            * 2.1790
            * w.power(0.7171)
            * polynomial(b, &[0.6840, -0.0077, 0.1473])
            * 0.2081
            * r_pin.power(-0.5231)
            * polynomial(d_journal, &[0.9993, 0.27, -1.0211, 0.5306])
            * polynomial(d_pin, &[0.9978, 0.3145, -1.5241, 2.4147])
            * recess;
        let journal_bending = 2.7146
            * journal_overlap(limited, w)
            * 2.2422
            * w.power(0.7548)
            * polynomial(b, &[0.5616, 0.1197, 0.1176])
            * 0.1908
            * r_journal.power(-0.5568)
            * polynomial(d_journal, &[1.0012, -0.6441, 1.2265])
            * polynomial(d_pin, &[1.0022, -0.1903, 0.0073])
            * recess;
        let radial = 3.0128
            * polynomial(1.0 - limited, &[0.4368, 2.1630, -1.5212])
            * (w / (0.0637 + 0.9369 * w))
            * (b - 0.5)
            * 0.5331
            * r_journal.power(-0.2038)
            * polynomial(d_pin, &[0.9937, -1.1949, 1.7373])
            * recess;
        let level = match formulas {
            Formulas::IacsM53 => 0.8 * w.power(-0.145),
            Formulas::Fvv1973 => 0.9230,
        };
        let torsion = |r: f64| level * r.power(-0.2205 - 0.1015 * limited) * polynomial(b, &[7.8955, -10.654, 5.3482, -0.857]);
        let bore = |x: f64| {
            let d = g.relative(x);
            Factors { bending: polynomial(d, &[3.0, -5.88, 34.6]), radial: 0.0, torsion: polynomial(d, &[4.0, -6.0, 30.0]) }
        };
        Self {
            crankpin: Factors { bending: pin_bending, radial: 0.0, torsion: torsion(r_pin) },
            // the journal's fillet is set against its own diameter
            journal: Factors {
                bending: journal_bending,
                radial: if formulas == Formulas::IacsM53 { radial } else { 0.0 },
                torsion: torsion(g.journal_fillet / g.journal_diameter),
            },
            oil_bore: g.oil_bore.map(bore),
        }
    }
}

/// f(s, w) of the crankpin.
fn pin_overlap(s: f64, w: f64) -> f64 {
    let t = 1.0 - s;
    polynomial(w, &[-4.1883, 29.2004, -77.5925, 91.9454, -40.0416])
        + t * polynomial(w, &[9.5440, -58.3480, 159.3415, -192.5846, 85.2916])
        + t * t * polynomial(w, &[-3.8399, 25.0444, -70.5571, 87.0328, -39.1832])
}

/// f_B(s, w) of the journal.
fn journal_overlap(s: f64, w: f64) -> f64 {
    let t = 1.0 - s;
    polynomial(w, &[-1.7625, 2.9821, -1.5276])
        + t * polynomial(w, &[5.1169, -5.8089, 3.1391])
        + t * t * polynomial(w, &[-2.1567, 2.3297, -1.2952])
}
