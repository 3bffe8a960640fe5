//! A cylinder: d = |(x - p) across a| - r. No closed form: axes all around the half sphere are tried, each with the circle that the
//! points make along it, and the best three go on.

use nalgebra::Vector3;

use super::circle::Circle;
use super::form::{GeometricForm, LinearisedDistance, MOST, Second};
use super::line::Line;
use super::linear::across;

/// Axis and radius.
#[derive(Clone, Debug)]
pub struct Cylinder {
    pub axis: Line,
    pub radius: f64,
}

/// Axes that are tried: no axis is farther than about 5° from one of them.
const AXES: usize = 400;

impl Cylinder {
    /// The best of the axes that are tried, best first. Points are about 0 and of size 1.
    pub fn initial(points: &[Vector3<f64>]) -> Vec<Self> {
        let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
        // Many points tell an axis no better than some of them.
        let some: Vec<Vector3<f64>> = points.iter().step_by(points.len().div_ceil(300)).copied().collect();
        let mut found: Vec<(f64, Self)> = (0..AXES)
            .filter_map(|k| {
                let z = (k as f64 + 0.5) / AXES as f64;
                let turn = std::f64::consts::TAU * (k as f64 / golden).fract();
                let r = (1.0 - z * z).sqrt();
                let direction = Vector3::new(r * turn.cos(), r * turn.sin(), z);
                let circle = Circle::initial(&some, &direction)?;
                let cylinder = Self { axis: Line { position: circle.centre, direction }, radius: circle.radius };
                let cost = some.iter().map(|x| cylinder.distance(x).powi(2)).sum::<f64>();
                cost.is_finite().then_some((cost, cylinder))
            })
            .collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut best: Vec<Self> = Vec::new();
        for (_, cylinder) in found {
            let near = |other: &Self| other.axis.direction.dot(&cylinder.axis.direction).abs() > 0.97;
            if !best.iter().any(near) {
                best.push(cylinder);
            }
            if best.len() == 4 {
                break;
            }
        }
        best
    }
}

impl GeometricForm for Cylinder {
    /// Two shifts across the axis, two turns, radius.
    const PARAMETERS: usize = 5;

    fn rows(&self, points: &[Vector3<f64>]) -> Vec<LinearisedDistance> {
        let Line { position, direction } = &self.axis;
        let [e, f] = across(direction);
        let row = |(point, x): (usize, &Vector3<f64>)| {
            let v = x - position;
            let along = direction.dot(&v);
            let across = v - along * direction;
            let length = across.norm();
            let outwards = if length > 0.0 { across / length } else { e };
            let (oe, of) = (outwards.dot(&e), outwards.dot(&f));
            let by_form = [-oe, -of, -along * oe, -along * of, -1.0, 0.0];
            LinearisedDistance { point, distance: length - self.radius, by_form, by_point: outwards }
        };
        points.iter().enumerate().map(row).collect()
    }

    fn second(&self, point: &Vector3<f64>) -> Second {
        let mut second = Second::zeros();
        let Line { position, direction } = &self.axis;
        second.add_across(self.distance(point), &(point - position), direction, &self.axis.motions());
        second
    }

    fn moved(&self, step: &[f64; MOST]) -> Self {
        Self { axis: self.axis.moved(step), radius: self.radius + step[4] }
    }

    fn anchored(self, centroid: &Vector3<f64>) -> Self {
        Self { axis: self.axis.anchored(centroid), ..self }
    }

    fn distance(&self, point: &Vector3<f64>) -> f64 {
        self.axis.distance(point) - self.radius
    }
}
