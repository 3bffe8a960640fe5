//! Targets on simple forms, with the faces that occlude those behind.

use crate::reason::PlanReason;
use std::f64::consts::{PI, TAU};

use nalgebra::Vector3;

use sightline::error::{Error, Place, Reason, Result};
use sightline::limits;
use sightline::project::{Form, Plan, PlanFace, Point};

use super::setup::{LARGEST, fill_distance, principal_distance_px};

/// Facets that approximate a cylinder.
const FACETS: usize = 24;
/// Largest angle, radians, at which targets are still to be large enough; the plan's largest incidence where that is less.
const SLANT: f64 = PI / 3.0;

/// The smallest diameter of targets that are large enough in a photo of the whole object, also on faces that are seen at a slant, in the
/// plan's unit: D·l/(c·cos i), where D is the distance from which the object fills the picture, l the smallest axis wanted and c the
/// principal distance, both in pixels, and i the largest incidence, at most 60°. `None` without points or without a camera whose principal distance is known.
pub fn least_diameter(plan: &Plan) -> Option<f64> {
    let camera = plan.cameras.first()?;
    let places: Vec<Vector3<f64>> = plan.points.iter().filter_map(|p| p.xyz.map(Vector3::from)).collect();
    let centre = places.iter().sum::<Vector3<f64>>() / places.len() as f64;
    let radius = places.iter().map(|p| (p - centre).norm()).reduce(f64::max)?;
    let slant = plan.max_incidence.min(SLANT);
    Some(fill_distance(camera, plan.margin, radius) * plan.least_px / (principal_distance_px(camera)? * slant.cos()))
}

/// How many faces a form has.
pub fn faces_on(form: &Form) -> usize {
    match form {
        Form::Plane { .. } => 1,
        Form::Box { .. } => 5,
        Form::Cylinder { .. } => FACETS,
    }
}

/// Points and faces of a form; counts are at least 1.
///
/// # Errors
/// Those of [`check_form`].
pub fn targets_on(form: &Form) -> Result<(Vec<Point>, Vec<PlanFace>)> {
    check_form(form)?;
    let mut made = FormTargets::default();
    match *form {
        Form::Plane { width, height, columns, rows, upright, diameter } => {
            let (corner, across, normal) = if upright {
                ([-width / 2.0, 0.0, 0.0], [0.0, 0.0, height], [0.0, -1.0, 0.0])
            } else {
                ([-width / 2.0, -height / 2.0, 0.0], [0.0, height, 0.0], [0.0, 0.0, 1.0])
            };
            made.face(PlanFace { corner, along: [width, 0.0, 0.0], across }, normal, [columns, rows], diameter);
        }
        Form::Box { size: [x, y, z], columns, rows, diameter } => {
            let corner = |sx: f64, sy: f64, z: f64| [sx * x / 2.0, sy * y / 2.0, z];
            let up = [0.0, 0.0, z];
            let sides = [
                (corner(-1.0, -1.0, 0.0), [x, 0.0, 0.0], up, [0.0, -1.0, 0.0]),
                (corner(1.0, -1.0, 0.0), [0.0, y, 0.0], up, [1.0, 0.0, 0.0]),
                (corner(1.0, 1.0, 0.0), [-x, 0.0, 0.0], up, [0.0, 1.0, 0.0]),
                (corner(-1.0, 1.0, 0.0), [0.0, -y, 0.0], up, [-1.0, 0.0, 0.0]),
                (corner(-1.0, -1.0, z), [x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, 1.0]),
            ];
            for (corner, along, across, normal) in sides {
                made.face(PlanFace { corner, along, across }, normal, [columns, rows], diameter);
            }
        }
        Form::Cylinder { radius, height, sweep, columns, rows, inside, diameter } => {
            let whole = sweep >= TAU - 1e-9;
            let (columns, rows) = (columns.max(1), rows.max(1));
            let steps = if whole { columns } else { columns.saturating_sub(1).max(1) };
            for row in 0..rows {
                let z = height * (f64::from(row) + 0.5) / f64::from(rows);
                for column in 0..columns {
                    let share = if columns == 1 { 0.5 } else { f64::from(column) / f64::from(steps) };
                    let angle = -PI / 2.0 + sweep.min(TAU) * (share - 0.5);
                    let out = [angle.cos(), angle.sin(), 0.0];
                    let xyz = [radius * out[0], radius * out[1], z];
                    let normal = if inside { out.map(|n| -n) } else { out };
                    made.point(xyz, normal, diameter);
                }
            }
            // Chords lie inside the circle and tangents outside of it, so that no target is behind its own.
            let reach = if inside { 1.001 * radius / (PI / FACETS as f64).cos() } else { radius };
            let at = |k: usize| {
                let angle = TAU * k as f64 / FACETS as f64;
                [reach * angle.cos(), reach * angle.sin()]
            };
            for k in 0..FACETS {
                let (a, b) = (at(k), at(k + 1));
                made.faces.push(PlanFace {
                    corner: [a[0], a[1], 0.0],
                    along: [b[0] - a[0], b[1] - a[1], 0.0],
                    across: [0.0, 0.0, height],
                });
            }
        }
    }
    Ok((made.points, made.faces))
}

/// Whether a form's targets can be made.
///
/// # Errors
/// [`Error::Invalid`] for more targets than [`limits::TARGETS`], and sizes beyond all measure.
pub fn check_form(form: &Form) -> Result<()> {
    let (sizes, with_targets, columns, rows) = match *form {
        Form::Plane { width, height, columns, rows, diameter, .. } => {
            ([width, height, 0.0, diameter], 1, columns, rows)
        }
        Form::Box { size: [x, y, z], columns, rows, diameter } => ([x, y, z, diameter], 5, columns, rows),
        Form::Cylinder { radius, height, sweep, columns, rows, diameter, .. } => {
            ([radius, height, sweep, diameter], 1, columns, rows)
        }
    };
    let invalid = |reason, field: &str| Err(Error::Invalid { reason, at: Place::field(field) });
    if !sizes.iter().all(|size| size.abs() < LARGEST) {
        return invalid(Reason::NotFinite, "size");
    }
    let count = (columns.max(1) as usize).saturating_mul(rows.max(1) as usize).saturating_mul(with_targets);
    if count > limits::TARGETS {
        invalid(PlanReason::FormTooMany { limit: limits::TARGETS }.into(), "columns")
    } else {
        Ok(())
    }
}

#[derive(Default)]
struct FormTargets {
    points: Vec<Point>,
    faces: Vec<PlanFace>,
}

impl FormTargets {
    fn point(&mut self, xyz: [f64; 3], normal: [f64; 3], diameter: f64) {
        self.points.push(Point {
            id: (self.points.len() + 1).to_string(),
            xyz: Some(xyz),
            normal: Some(normal),
            diameter: (diameter > 0.0).then_some(diameter),
            ..Point::default()
        });
    }

    /// Targets in the middles of a face's cells.
    fn face(&mut self, face: PlanFace, normal: [f64; 3], [columns, rows]: [u32; 2], diameter: f64) {
        let (columns, rows) = (columns.max(1), rows.max(1));
        for row in 0..rows {
            for column in 0..columns {
                let a = (f64::from(column) + 0.5) / f64::from(columns);
                let b = (f64::from(row) + 0.5) / f64::from(rows);
                let xyz = [0, 1, 2].map(|k| face.corner[k] + a * face.along[k] + b * face.across[k]);
                self.point(xyz, normal, diameter);
            }
        }
        self.faces.push(face);
    }
}
