//! Curves on their way to a table and a plot.

use crate::engine::Order;

/// What stands on an axis: its column with unit, and its words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Axis {
    /// Name in tables.
    pub column: &'static str,
    /// Description in plots.
    pub label: &'static str,
}

/// Crank angle from the firing of the cylinder that fires at 0°.
pub(crate) const CRANK_DEG: Axis = Axis { column: "crank_deg", label: "crank angle / °" };
/// Speed.
pub(crate) const SPEED: Axis = Axis { column: "speed_rpm", label: "speed / rpm" };
/// Order.
pub(crate) const ORDER: Axis = Axis { column: "order", label: "order" };
/// Torque.
pub(crate) const TORQUE: Axis = Axis { column: "torque_n_m", label: "torque / N m" };
/// Force.
pub(crate) const FORCE: Axis = Axis { column: "force_n", label: "force / N" };
/// Moment.
pub(crate) const MOMENT: Axis = Axis { column: "moment_n_m", label: "moment / N m" };
/// Travel of the piston.
pub(crate) const TRAVEL: Axis = Axis { column: "travel_mm", label: "travel / mm" };
/// Velocity of the piston.
pub(crate) const VELOCITY: Axis = Axis { column: "velocity_m_per_s", label: "velocity / m/s" };
/// Acceleration of the piston.
pub(crate) const ACCELERATION: Axis = Axis { column: "acceleration_m_per_s2", label: "acceleration / m/s²" };
/// Angle.
pub(crate) const ANGLE: Axis = Axis { column: "angle_deg", label: "angle / °" };

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Look {
    /// A line of its own colour and dashes.
    Line,
    /// A line of an order: the same in every plot.
    Order(Order),
    /// A black line, above the others; those of one panel are told apart by their number.
    Black(usize),
    /// A thin grey line beside what the panel shows: a limit, a circle.
    Thin,
    /// Points without a line between them.
    Points,
}

/// How far the axes of a panel reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scale {
    /// As far as its curves.
    Own,
    /// Upwards as far as this at least, so that figures can share it.
    AtLeast(f64),
    /// Upwards as far as this: curves end there.
    CutAt(f64),
    /// Both axes have the same unit: a circle looks like one.
    Equal,
}

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Its name.
    pub label: String,
    /// How it is drawn.
    pub look: Look,
    /// Its points.
    pub points: Vec<(f64, f64)>,
}

/// Curves on common axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Its title.
    pub title: String,
    /// Across.
    pub x: Axis,
    /// Upwards.
    pub y: Axis,
    /// The curves.
    pub curves: Vec<Curve>,
    /// How far its axes reach.
    pub scale: Scale,
}

/// Panels that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Name of its files.
    pub name: String,
    /// Its title.
    pub title: String,
    /// From top to bottom.
    pub panels: Vec<Panel>,
}

/// A curve of two columns.
#[doc(hidden)]
pub fn curve(label: impl Into<String>, x: impl IntoIterator<Item = f64>, y: impl IntoIterator<Item = f64>) -> Curve {
    Curve { label: label.into(), look: Look::Line, points: x.into_iter().zip(y).collect() }
}
