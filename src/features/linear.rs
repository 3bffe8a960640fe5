//! Linearised functions of points and their covariances.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use crate::error::Result;

/// Derivatives of a quantity with respect to the points that it depends on: index of the point, derivatives by X, Y, Z.
pub type Function = Vec<(usize, Vector3<f64>)>;

/// Computes the covariances of each function with each point, from the adjustment; `None` without statistics.
pub type Carry<'a> = &'a mut dyn FnMut(&[Function]) -> Result<Option<Vec<Vec<Vector3<f64>>>>>;

/// Σ factor · function.
pub fn sum<'a>(parts: impl IntoIterator<Item = (f64, &'a Function)>) -> Function {
    let mut all = BTreeMap::<usize, Vector3<f64>>::new();
    for (factor, function) in parts {
        for (point, by) in function {
            *all.entry(*point).or_default() += factor * by;
        }
    }
    all.into_iter().collect()
}

/// A vector that depends on points: its value and the derivative of each component.
#[derive(Clone, Debug, Default)]
pub struct Vector {
    pub value: Vector3<f64>,
    pub by: [Function; 3],
}

impl Vector {
    /// The position of a point.
    pub fn of_point(point: usize, value: Vector3<f64>) -> Self {
        Self { value, by: std::array::from_fn(|axis| vec![(point, axis_of(axis))]) }
    }

    /// Derivative of g · vector with constant g.
    pub fn along(&self, g: &Vector3<f64>) -> Function {
        sum((0..3).map(|k| (g[k], &self.by[k])))
    }
}

/// Unit vector of an axis.
pub fn axis_of(axis: usize) -> Vector3<f64> {
    Vector3::from_fn(|k, _| if k == axis { 1.0 } else { 0.0 })
}

/// Covariance of a function with another one, of which the covariances with all points are given (see [`Carry`]).
pub fn covariance(function: &Function, with_points: &[Vector3<f64>]) -> f64 {
    function.iter().map(|(point, by)| by.dot(&with_points[*point])).sum()
}

/// Standard error from a variance; 0 if rounding made the variance negative.
pub fn root(variance: f64) -> f64 {
    variance.max(0.0).sqrt()
}

/// Two unit vectors that form a right-handed system with the unit vector `n`: (first, second, n).
pub fn across(n: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let least = (0..3).min_by(|a, b| n[*a].abs().total_cmp(&n[*b].abs())).unwrap_or(0);
    let first = n.cross(&axis_of(least)).normalize();
    [first, n.cross(&first)]
}
