//! A plane: d = n·(x - p), in closed form along the smallest principal axis of the points (Pearson 1901), then like the others.

use nalgebra::Vector3;

use super::form::{AxisMotion, GeometricForm, LinearisedDistance, MOST, Second};
use super::linear::across;

/// A point of the plane and its unit normal.
#[derive(Clone, Debug)]
pub struct Plane {
    pub position: Vector3<f64>,
    pub normal: Vector3<f64>,
}

impl GeometricForm for Plane {
    /// Shift along the normal, two turns.
    const PARAMETERS: usize = 3;

    fn rows(&self, points: &[Vector3<f64>]) -> Vec<LinearisedDistance> {
        let [e, f] = across(&self.normal);
        let row = |(point, x): (usize, &Vector3<f64>)| {
            let v = x - self.position;
            let mut by_form = [0.0; MOST];
            by_form[..3].copy_from_slice(&[-1.0, e.dot(&v), f.dot(&v)]);
            LinearisedDistance { point, distance: self.normal.dot(&v), by_form, by_point: self.normal }
        };
        points.iter().enumerate().map(row).collect()
    }

    fn second(&self, point: &Vector3<f64>) -> Second {
        let [e, f] = across(&self.normal);
        let turn = |turn| AxisMotion { turn, ..AxisMotion::default() };
        let mut second = Second::zeros();
        let motions = [AxisMotion { shift: self.normal, ..AxisMotion::default() }, turn(e), turn(f)];
        second.add_height(self.distance(point), &motions);
        second
    }

    fn moved(&self, step: &[f64; MOST]) -> Self {
        let [e, f] = across(&self.normal);
        Self {
            position: self.position + step[0] * self.normal,
            normal: (self.normal + step[1] * e + step[2] * f).normalize(),
        }
    }

    fn anchored(self, centroid: &Vector3<f64>) -> Self {
        Self { position: centroid - self.distance(centroid) * self.normal, ..self }
    }

    fn distance(&self, point: &Vector3<f64>) -> f64 {
        self.normal.dot(&(point - self.position))
    }
}
