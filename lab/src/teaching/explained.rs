//! One observation explained: its collinearity equation with numbers, each derivative beside a numerical one, and the distribution of its error.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::dense::{carried, cofactors, redundancy};
use sightline::adjust::{Adjuster, LinearSystem, Unknown, UnknownKind, linearise};
use sightline::adjustment::AdjustOptions;
use sightline::error::Result;
use sightline::project::{Interior, Parameter, Project};
use sightline::rotation;

/// x = x0 - c U / W + Δx in numbers. In photo coordinates of pixels, whose second axis points down, the sign of the second equation is +.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Collinearity {
    /// The point seen from the projection centre, along the axes of the camera, in the document's unit.
    pub uvw: [f64; 3],
    /// Coordinate of the principal point.
    pub principal_point: f64,
    /// Principal distance.
    pub principal_distance: f64,
    /// -1, or +1 for an axis that points down.
    pub sign: f64,
    /// Contribution of distortion and eccentricity.
    pub correction: f64,
    /// The whole: the computed coordinate.
    pub computed: f64,
}

/// A derivative of an observation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Derivative {
    /// Column of A.
    pub unknown: usize,
    /// The entry of A.
    pub analytic: f64,
    /// Difference quotient of the computed observation; `None` for given values, which are start values too and would move with them.
    pub numerical: Option<f64>,
    /// How far an error of one standard error of the observation moves the unknown; `None` above [`super::LARGEST`] unknowns.
    pub moved: Option<f64>,
}

/// An observation explained.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Explained {
    /// Row of A.
    pub row: usize,
    /// Its equation; `None` for given values, and for camera models without this form.
    pub collinearity: Option<Collinearity>,
    /// One for every entry of its row.
    pub derivatives: Vec<Derivative>,
    /// Redundancy number; `None` above [`super::LARGEST`] unknowns.
    pub redundancy: Option<f64>,
}

/// Steps of difference quotients, in the engine's scaled unknowns: the error of the quotient is of their square, that of rounding of their inverse.
const STEP: f64 = 1e-5;

/// Explains the observation of a row of A at the present values of an adjustment.
///
/// # Errors
/// As [`linearise`].
pub fn explain(at: &Adjuster, options: &AdjustOptions, row: usize) -> Result<Explained> {
    let system = at.linear_system()?;
    if row >= system.observations.len() {
        return Ok(Explained { row, ..Explained::default() });
    }
    let q = cofactors(&system);
    let carried = q.as_ref().map(|q| carried(&system, q, row));
    let sigma = system.observations[row].sigma;
    // Control points and observed parameters too at their present values, which the state's document keeps as given.
    let not_turned = system.unknowns.iter().filter(|unknown| unknown.kind != UnknownKind::Rotation);
    let here = not_turned.fold(at.state().project.clone(), |here, unknown| changed(&here, unknown, 0.0));
    let mut derivatives = Vec::new();
    for (unknown, analytic) in system.a.row(row) {
        let step = STEP * system.unknowns[unknown].scale;
        let misclosure = |by: f64| -> Result<f64> {
            let there = linearise(&changed(&here, &system.unknowns[unknown], by), options)?;
            Ok(there.l[row])
        };
        let numerical = match system.observations[row].given {
            None => Some((misclosure(-step)? - misclosure(step)?) / (2.0 * step)),
            Some(_) => None,
        };
        let moved = carried.as_ref().map(|carried| carried[unknown] * system.p[row] * sigma);
        derivatives.push(Derivative { unknown, analytic, numerical, moved });
    }
    Ok(Explained {
        row,
        collinearity: collinearity(&here, &system, row),
        derivatives,
        redundancy: carried.as_ref().map(|carried| redundancy(&system, carried, row)),
    })
}

fn collinearity(project: &Project, system: &LinearSystem, row: usize) -> Option<Collinearity> {
    let equation = &system.observations[row];
    let (photo, point) = (equation.photo.as_ref()?, equation.point.as_ref()?);
    let photo = project.photos.iter().find(|other| other.id == *photo)?;
    let point = project.points.iter().find(|other| other.id == *point)?;
    let camera = project.cameras.iter().find(|camera| camera.id == photo.camera)?;
    let interior = photo.interior.as_ref().filter(|_| camera.per_photo).unwrap_or(&camera.interior);
    let second = equation.axis.as_deref() == Some("y");
    let of = |parameter| interior.get(parameter);
    let (principal_distance, principal_point, sign) = match interior {
        Interior::Brown { .. } => (of(Parameter::C)?, of(if second { Parameter::Y0 } else { Parameter::X0 })?, -1.0),
        Interior::Opencv { .. } => {
            let focal = of(if second { Parameter::Fy } else { Parameter::Fx })?;
            (focal, of(if second { Parameter::Cy } else { Parameter::Cx })?, if second { 1.0 } else { -1.0 })
        }
        _ => return None,
    };
    let m = rotation::object_to_camera(photo.rotation?);
    let uvw = m * (Vector3::from(point.xyz?) - Vector3::from(photo.position?));
    let computed = equation.value - system.l[row];
    let ideal = principal_point + sign * principal_distance * uvw[usize::from(second)] / uvw[2];
    let correction = computed - ideal;
    Some(Collinearity { uvw: uvw.into(), principal_point, principal_distance, sign, correction, computed })
}

/// The document with one unknown at its present value changed by `by`; a rotation from the document's own.
fn changed(project: &Project, unknown: &Unknown, by: f64) -> Project {
    let mut project = project.clone();
    let axis =
        |names: [&str; 3]| names.iter().position(|axis| unknown.name.ends_with(&format!(" {axis}"))).unwrap_or(0);
    let is = |id: &String, of: &Option<String>| of.as_ref() == Some(id);
    match unknown.kind {
        UnknownKind::Rotation => {
            if let Some(photo) = project.photos.iter_mut().find(|photo| is(&photo.id, &unknown.photo)) {
                let mut turn = Vector3::zeros();
                turn[axis(["x", "y", "z"])] = by;
                let m = rotation::object_to_camera(photo.rotation.unwrap_or_default());
                photo.rotation = Some(rotation::angles(&rotation::turned(&m, turn)));
            }
        }
        UnknownKind::ProjectionCentre => {
            let photo = project.photos.iter_mut().find(|photo| is(&photo.id, &unknown.photo));
            if let Some(position) = photo.and_then(|photo| photo.position.as_mut()) {
                position[axis(["X", "Y", "Z"])] = unknown.value + by;
            }
        }
        UnknownKind::Point => {
            let point = project.points.iter_mut().find(|point| is(&point.id, &unknown.point));
            if let Some(xyz) = point.and_then(|point| point.xyz.as_mut()) {
                xyz[axis(["X", "Y", "Z"])] = unknown.value + by;
            }
        }
        UnknownKind::InteriorOrientation => {
            let name = unknown.name.rsplit(' ').next().unwrap_or_default();
            let camera = project.cameras.iter_mut().find(|camera| is(&camera.id, &unknown.camera));
            let own = unknown.photo.is_some();
            let photo = project.photos.iter_mut().find(|photo| own && is(&photo.id, &unknown.photo));
            let Some(camera) = camera else { return project };
            let interior = match photo {
                Some(photo) => photo.interior.get_or_insert(camera.interior),
                None => &mut camera.interior,
            };
            let parameter = interior.parameters().iter().copied().find(|parameter| parameter.name() == name);
            if let Some(parameter) = parameter {
                interior.set(parameter, unknown.value + by);
            }
        }
    }
    project
}
