//! Observation equations, reduced normal equations by the Schur complement, back-substitution, ordering.

pub mod back_substitution;
pub mod collinearity;
pub mod context;
pub mod normal;
pub mod ordering;
pub mod right_hand_side;
pub mod schur;
