//! Matrices of structures as finite-element programs write them: Matrix Market, CalculiX (`.sti`, `.mas` with `.dof`), substructures of CalculiX and Abaqus (`.mtx`), matrices of Abaqus, DMIG and OP4 of Nastran.

mod abaqus;
mod coordinate;
mod dmig;
mod lines;
mod op4;
mod structure;
mod user_element;

pub use structure::{MatrixFiles, UnitSystem, structure};
