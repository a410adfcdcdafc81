//! All tests of hartog, one binary. "Equals itself" and "equals the literature" are told apart in each test's first line.

mod absorbers;
mod bad_input;
mod calibration;
mod chains;
mod choice;
mod commands;
mod comparison;
mod conditions;
mod enclosing;
mod engines;
mod fatigue;
mod forces;
mod laws;
mod layering;
mod long;
mod margin;
mod methods;
mod multiaxial;
mod multiaxial_margin;
mod numerics;
mod optima;
mod peaks;
mod planes;
mod responses;
mod shaft;
mod support;
