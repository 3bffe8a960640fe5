//! What the fitted forms have in common: rows of distances with their derivatives, and what comes out of a fit.

use nalgebra::Vector3;

use super::linear::{Function, Vector};

/// Most parameters of a form.
pub const MOST: usize = 6;

/// Distance of a point from a form, linearised.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Number of the point in the list that is fitted.
    pub point: usize,
    /// Distance, or one of its components.
    pub distance: f64,
    /// By the form's parameters.
    pub by_form: [f64; MOST],
    /// By the point's coordinates.
    pub by_point: Vector3<f64>,
}

/// A form that is fitted to points. Its parameters are small changes of the present form, so that no attitude is singular.
pub trait Form: Clone {
    /// Number of parameters.
    const PARAMETERS: usize;
    /// Linearised distances of the points, one row or two a point.
    fn rows(&self, points: &[Vector3<f64>]) -> Vec<Row>;
    /// The form after a step.
    fn moved(&self, step: &[f64; MOST]) -> Self;
    /// The same form, told about the foot of the points' centroid.
    fn anchored(self, centroid: &Vector3<f64>) -> Self;
    /// Signed distance of a point.
    fn distance(&self, point: &Vector3<f64>) -> f64;
}

/// A form with what its figures depend on.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// Centre, or foot of the centroid.
    pub position: Vector,
    /// Unit direction or normal.
    pub direction: Option<Vector>,
    /// Radius.
    pub radius: Option<(f64, Function)>,
    /// What distances from it mean.
    pub shape: Shape,
    /// Signed distances of its own points, in their order.
    pub residuals: Vec<f64>,
}

/// Kinds of forms, as far as distances between them go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Points; centres of spheres.
    Place,
    /// A centre with a normal.
    Circle,
    /// A line.
    Line,
    /// An axis with a radius.
    Cylinder,
    /// A plane.
    Plane,
}

impl Shape {
    /// Whether it lies along its direction.
    pub fn is_axis(self) -> bool {
        matches!(self, Self::Line | Self::Cylinder)
    }

    /// Whether distances from it are those from its position.
    pub fn is_place(self) -> bool {
        matches!(self, Self::Place | Self::Circle)
    }
}
