//! Why sizing ends without an answer.

use super::eye;

/// Largest relative change of a dimension in the last round.
pub(super) const TOLERANCE: f64 = 1e-10;
/// The same after the most rounds: friction that changes its sign with a normal force near zero may keep rounds from settling further.
pub(super) const LOOSE: f64 = 1e-6;
/// Most rounds.
pub(super) const MOST_ROUNDS: usize = 200;
/// Widest web, in diameters of the crankpin.
pub(super) const WIDEST_WEB: f64 = 20.0;

/// Sizing ends without an answer.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SizingError {
    /// Half a crankpin and a web fill a side of the span between the bearings.
    #[error("half of a crankpin of {:.1} mm and a web of {:.1} mm need more room than there is to the bearing {side} the throw, {:.1} mm: move it away, or take a stronger steel, a finer surface or a smaller design factor", 1e3 * crankpin_length, 1e3 * web_thickness, 1e3 * room)]
    NoRoom {
        /// m.
        crankpin_length: f64,
        /// m.
        web_thickness: f64,
        /// Before or after.
        side: &'static str,
        /// m.
        room: f64,
    },
    /// Dimensions that hold their loads, but not each other.
    #[error("{0}")]
    DoesNotFit(String),
    /// No breadth of the web holds.
    #[error("no web up to {WIDEST_WEB} crankpin diameters wide holds at a thickness of {:.1} mm: take a stronger steel, a finer surface, a smaller design factor, or give a thicker web", 1e3 * thickness)]
    Web {
        /// m.
        thickness: f64,
    },
    /// No eye holds.
    #[error("no {} up to {} times as wide as its bore of {:.1} mm holds the pull of the pin: take a stronger steel, a finer surface or a smaller design factor", eye.replace('_', " "), eye::RATIOS.1, 1e3 * bore)]
    Eye {
        /// Its name.
        eye: &'static str,
        /// m.
        bore: f64,
    },
    /// A dimension grows without limit.
    #[error("`{dimension}` grows without limit, to {:.3} m in round {round}: masses and forces drive each other up", value)]
    Diverges {
        /// Its name.
        dimension: &'static str,
        /// m.
        value: f64,
        /// From 1.
        round: usize,
    },
    /// Rounds do not settle.
    #[error("dimensions still change by {change:.1e} in round {MOST_ROUNDS}, expected {LOOSE:.0e}")]
    NotConverged {
        /// Largest relative change of the last round.
        change: f64,
    },
}
