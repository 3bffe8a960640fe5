//! A line in space: the distance is the part of x - p across the direction a, two components a point.

use nalgebra::Vector3;

use super::form::{AxisMotion, GeometricForm, LinearisedDistance, MOST, Second};
use super::linear::across;

/// A point of the line and its unit direction.
#[derive(Clone, Debug)]
pub struct Line {
    pub position: Vector3<f64>,
    pub direction: Vector3<f64>,
}

impl Line {
    /// The foot of a point on it.
    pub fn foot(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.position + self.direction.dot(&(point - self.position)) * self.direction
    }

    /// Of its parameters.
    pub fn motions(&self) -> [AxisMotion; 4] {
        let [e, f] = across(&self.direction);
        let shift = |shift| AxisMotion { shift, ..AxisMotion::default() };
        let turn = |turn| AxisMotion { turn, ..AxisMotion::default() };
        [shift(e), shift(f), turn(e), turn(f)]
    }
}

impl GeometricForm for Line {
    /// Two shifts across, two turns.
    const PARAMETERS: usize = 4;

    fn rows(&self, points: &[Vector3<f64>]) -> Vec<LinearisedDistance> {
        let sides = across(&self.direction);
        let rows = points.iter().enumerate().flat_map(|(point, x)| {
            let v = x - self.position;
            let along = self.direction.dot(&v);
            (0..2).map(move |k| {
                let mut by_form = [0.0; MOST];
                (by_form[k], by_form[2 + k]) = (-1.0, -along);
                LinearisedDistance { point, distance: sides[k].dot(&v), by_form, by_point: sides[k] }
            })
        });
        rows.collect()
    }

    /// Of |u|²/2 beyond its two components' squares of first derivatives: -(turn·u)(turn'·u), and -(turn·u) a by a point.
    fn second(&self, point: &Vector3<f64>) -> Second {
        let u = point - self.foot(point);
        let mut second = Second::zeros();
        let motions = self.motions();
        for (k, one) in motions.iter().enumerate() {
            second.by_point[k] = -one.turn.dot(&u) * self.direction;
            for (l, other) in motions.iter().enumerate() {
                second.by_form[(k, l)] = -one.turn.dot(&u) * other.turn.dot(&u);
            }
        }
        second
    }

    fn moved(&self, step: &[f64; MOST]) -> Self {
        let [e, f] = across(&self.direction);
        Self {
            position: self.position + step[0] * e + step[1] * f,
            direction: (self.direction + step[2] * e + step[3] * f).normalize(),
        }
    }

    fn anchored(self, centroid: &Vector3<f64>) -> Self {
        Self { position: self.foot(centroid), ..self }
    }

    fn distance(&self, point: &Vector3<f64>) -> f64 {
        (point - self.foot(point)).norm()
    }
}
