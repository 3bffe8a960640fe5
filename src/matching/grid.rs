//! Names the dots of a board of circular dots, photo by photo: no camera, orientation or order of the photos is needed.
//!
//! Dots are joined to lattices with places predicted from their neighbours alone ([`growth`], [`local`]), so that perspective and any
//! lens's distortion do not matter. A lattice is then laid on the board in every way ([`placement`]); it gives names where one way is
//! clearly the best. What the dots do not decide is reported, never guessed.

mod board;
mod growth;
mod local;
mod naming;
mod outcome;
mod placement;
mod reading;

pub use board::{Board, BoardKind};
pub use naming::name_grid;
pub use outcome::{GridNaming, GridOptions, GridOrientation, NamedGrid, Unnamed, UnnamedReason};
