//! Coordinate systems laid through adjusted points, and all points in them with standard errors.
//!
//! With y = s R (x - c) about a fixed c the system is x' = y + t. Its parameters move with the points by a turn w, a shift τ and a
//! stretch σ, so that
//!
//! ```text
//! dx' = s R dx + w × y + τ + σ y
//! ```
//!
//! and the covariance of a point in the system needs, besides its own, that of the seven with each other and with the point.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use super::form::Fitted;
use super::linear::{Carry, Function, Vector, covariance, root, sum};
use super::measure::{Points, fitted};
use crate::adjustment::{AdjustedPhoto, FeatureResidual, MeasuredSystem, SystemPoint};
use crate::error::{Error, Place, Reason, Result};
use crate::initial::{PrincipalAxes, similarity};
use crate::project::{CoordinateSystem, FeatureKind, GivenPoint, SystemKind};

/// Extents of a plane set that differ by less tell no longer side.
const ROUND: f64 = 1.05;
/// Turn, shift, stretch.
const PARAMETERS: usize = 7;

/// A system with what its parameters depend on.
struct Laid {
    centre: Vector3<f64>,
    rotation: Matrix3<f64>,
    scale: f64,
    shift: Vector3<f64>,
    by: [Function; PARAMETERS],
}

/// The system with all points in it.
///
/// # Errors
/// Those of `carry`.
pub fn measured(
    system: &CoordinateSystem,
    points: &Points,
    photos: &[AdjustedPhoto],
    carry: Carry<'_>,
) -> Result<MeasuredSystem> {
    let mut result = MeasuredSystem { id: system.id.clone(), ..MeasuredSystem::default() };
    let wanted: Vec<String> = match &system.kind {
        SystemKind::Automatic { points } => points.clone(),
        SystemKind::PlaneLinePoint { plane, line, point } => plane.iter().chain(line).chain([point]).cloned().collect(),
        SystemKind::BestFit { given, .. } => given.iter().map(|g| g.id.clone()).collect(),
    };
    result.missing = points.numbers(&wanted).1;
    let laid = match &system.kind {
        SystemKind::Automatic { points: chosen } => automatic(chosen, points, photos),
        SystemKind::PlaneLinePoint { plane, line, point } => plane_line_point([plane, line], point, points, photos),
        SystemKind::BestFit { given, scale } => best_fit(given, *scale, points, &mut result),
    };
    match laid {
        Ok(laid) => laid.tell(points, carry, &mut result)?,
        Err(error) => result.error = Some(Box::new(error)),
    }
    Ok(result)
}

fn refused(reason: Reason) -> Error {
    Error::Invalid { reason, at: Place::default() }
}

fn form(kind: &FeatureKind, needed: usize, points: &Points) -> Result<(Fitted, Vec<usize>)> {
    let (numbers, _) = points.numbers(kind.points());
    if numbers.len() < needed {
        return Err(refused(Reason::FeaturePoints { needed, given: numbers.len() }));
    }
    let places: Vec<Vector3<f64>> = numbers.iter().map(|k| points.at(*k)).collect();
    Ok((fitted(kind, &places, &numbers)?, numbers))
}

/// The plane's normal on the side of the photos.
fn towards_photos(plane: &Fitted, photos: &[AdjustedPhoto]) -> Vector {
    let normal = plane.direction.clone().unwrap_or_default();
    let side: f64 = photos.iter().map(|p| normal.value.dot(&(Vector3::from(p.position) - plane.position.value))).sum();
    if side < 0.0 { turned(&normal) } else { normal }
}

fn turned(vector: &Vector) -> Vector {
    Vector { value: -vector.value, by: std::array::from_fn(|k| sum([(-1.0, &vector.by[k])])) }
}

fn automatic(chosen: &[String], points: &Points, photos: &[AdjustedPhoto]) -> Result<Laid> {
    let ids = if chosen.is_empty() { points.all.iter().map(|p| p.id.clone()).collect() } else { chosen.to_vec() };
    let (plane, numbers) = form(&FeatureKind::Plane { points: ids }, 3, points)?;
    let z = towards_photos(&plane, photos);
    let places: Vec<Vector3<f64>> = numbers.iter().map(|k| points.at(*k)).collect();
    let spread = PrincipalAxes::of(&places).map_err(|_| refused(Reason::FeatureUndetermined))?;
    let elongated = spread.extent[0] > ROUND * spread.extent[1];
    // A round object has no longer side: its X is the adjustment's as far as the plane allows, or its Y.
    let along = if elongated {
        spread.axes.column(0).into_owned()
    } else if z.value.x.abs() < 0.9 {
        Vector3::x()
    } else {
        Vector3::y()
    };
    let mut x = (along - z.value.dot(&along) * z.value).normalize();
    if x[x.iamax()] < 0.0 {
        x = -x;
    }
    let y = z.value.cross(&x);
    // The principal axis turns by Σ(u dv + v du) / Σ(u² - v²).
    let turn = if elongated {
        let (mut by, mut difference) = (Function::new(), 0.0);
        for k in &numbers {
            let d = points.at(*k) - spread.centroid;
            let (u, v) = (x.dot(&d), y.dot(&d));
            by.push((*k, u * y + v * x));
            difference += u * u - v * v;
        }
        sum([(1.0 / difference, &by)])
    } else {
        let tilt = along.dot(&z.value) / (along - z.value.dot(&along) * z.value).norm();
        let sign = (along - z.value.dot(&along) * z.value).dot(&x).signum();
        sum([(-sign * tilt, &z.along(&y))])
    };
    Ok(Laid::with_axes([x, y, z.value], &z, turn, [&plane.position; 3], points))
}

fn plane_line_point(
    [plane, line]: [&[String]; 2],
    point: &str,
    points: &Points,
    photos: &[AdjustedPhoto],
) -> Result<Laid> {
    let (plane, _) = form(&FeatureKind::Plane { points: plane.to_vec() }, 3, points)?;
    let (line, _) = form(&FeatureKind::Line { points: line.to_vec() }, 2, points)?;
    let number = points.number(point).ok_or_else(|| refused(Reason::FeaturePointMissing { name: point.into() }))?;
    let origin = Vector::of_point(number, points.at(number));
    let z = towards_photos(&plane, photos);
    let b = line.direction.clone().unwrap_or_default();
    let upright = z.value.dot(&b.value);
    let flat = b.value - upright * z.value;
    // A line within half a degree of the normal tells no direction in the plane.
    if flat.norm() < 0.01 {
        return Err(refused(Reason::FeatureUndetermined));
    }
    let x = flat.normalize();
    let y = z.value.cross(&x);
    let turn = sum([(1.0 / flat.norm(), &b.along(&y)), (-upright / flat.norm(), &z.along(&y))]);
    Ok(Laid::with_axes([x, y, z.value], &z, turn, [&origin, &line.position, &plane.position], points))
}

/// Least weighted squares of x' - given, from the closed form on.
fn best_fit(given: &[GivenPoint], scaled: bool, points: &Points, result: &mut MeasuredSystem) -> Result<Laid> {
    let pairs: Vec<(usize, &GivenPoint)> = given.iter().filter_map(|g| Some((points.number(&g.id)?, g))).collect();
    if pairs.len() < 3 {
        return Err(refused(Reason::FeaturePoints { needed: 3, given: pairs.len() }));
    }
    let from: Vec<Vector3<f64>> = pairs.iter().map(|(k, _)| points.at(*k)).collect();
    let to: Vec<Vector3<f64>> = pairs.iter().map(|(_, g)| g.xyz.into()).collect();
    let start = similarity::fit(&from, &to).map_err(|_| refused(Reason::FeatureUndetermined))?.transform;
    let centre = start.source_centroid;
    let size = PrincipalAxes::of(&to).map_or(1.0, |s| s.extent.norm());
    let (mut rotation, mut shift) = (start.rotation, start.target_centroid);
    let mut scale = if scaled { start.scale } else { 1.0 };
    let count = if scaled { PARAMETERS } else { PARAMETERS - 1 };
    let weight = |g: &GivenPoint| Vector3::from(g.sigma.map_or([1.0; 3], |s| s.map(|s| 1.0 / (s * s))));
    let rows = |y: &Vector3<f64>| columns(&(y / size));
    let mut inverse = SMatrix::<f64, PARAMETERS, PARAMETERS>::identity();
    let mut settled = false;
    for _ in 0..100 {
        let mut normal = SMatrix::<f64, PARAMETERS, PARAMETERS>::zeros();
        let mut right = SVector::<f64, PARAMETERS>::zeros();
        for (x, (_, g)) in from.iter().zip(&pairs) {
            let y = scale * rotation * (x - centre);
            let (a, p) = (rows(&y), weight(g));
            let difference = Vector3::from(g.xyz) - y - shift;
            normal += a.transpose() * Matrix3::from_diagonal(&p) * a;
            right += a.transpose() * p.component_mul(&difference);
        }
        if !scaled {
            normal.row_mut(6).fill(0.0);
            normal.column_mut(6).fill(0.0);
            (normal[(6, 6)], right[6]) = (1.0, 0.0);
        }
        inverse = normal.try_inverse().ok_or_else(|| refused(Reason::FeatureUndetermined))?;
        let step = inverse * right;
        let turn = Vector3::new(step[0], step[1], step[2]) / size;
        rotation = nalgebra::Rotation3::from_scaled_axis(turn).into_inner() * rotation;
        shift += Vector3::new(step[3], step[4], step[5]);
        scale *= 1.0 + step[6] / size;
        // Beyond the digits of the coordinates, far below any standard error; steps go on until they change nothing.
        settled = step.amax() <= 1e-9 * size;
        if !(step.amax() > 1e-13 * size) {
            break;
        }
    }
    if !settled {
        return Err(refused(Reason::FeatureUnsettled));
    }
    let mut by: [Function; PARAMETERS] = Default::default();
    let mut squares = 0.0;
    for (x, (number, g)) in from.iter().zip(&pairs) {
        let y = scale * rotation * (x - centre);
        let p = weight(g);
        let m = inverse * rows(&y).transpose() * Matrix3::from_diagonal(&p) * (scale * rotation);
        for k in 0..count {
            let unit = if (3..6).contains(&k) { 1.0 } else { size };
            by[k].push((*number, -Vector3::new(m[(k, 0)], m[(k, 1)], m[(k, 2)]) / unit));
        }
        let difference = y + shift - Vector3::from(g.xyz);
        squares += difference.component_mul(&p).dot(&difference);
        result.residuals.push(FeatureResidual {
            point: g.id.clone(),
            value: difference.norm(),
            sigma: None,
            difference: Some(difference.into()),
        });
    }
    let redundancy = 3 * pairs.len() - count;
    result.redundancy = Some(redundancy);
    result.sigma0 = (redundancy > 0).then(|| (squares / redundancy as f64).sqrt());
    Ok(Laid { centre, rotation, scale, shift, by })
}

/// dx' by turn, shift and stretch: w × y = -[y]× w.
fn columns(y: &Vector3<f64>) -> SMatrix<f64, 3, PARAMETERS> {
    let mut a = SMatrix::<f64, 3, PARAMETERS>::zeros();
    a.fixed_view_mut::<3, 3>(0, 0).copy_from(&-y.cross_matrix());
    a.fixed_view_mut::<3, 3>(0, 3).copy_from(&Matrix3::identity());
    a.fixed_view_mut::<3, 1>(0, 6).copy_from(y);
    a
}

impl Laid {
    /// Axes that follow the normal `z` and turn about it by `turn`; coordinate k is 0 at the k-th anchor.
    ///
    /// Axes that turn by ω give coordinates that turn by w = -Rω, and ω = z × dz + turn z.
    fn with_axes(axes: [Vector3<f64>; 3], z: &Vector, turn: Function, anchors: [&Vector; 3], points: &Points) -> Self {
        let rotation = Matrix3::from_columns(&axes).transpose();
        let count = points.all.len().max(1) as f64;
        let centre = (0..points.all.len()).map(|k| points.at(k)).sum::<Vector3<f64>>() / count;
        let w = [z.along(&axes[1]), sum([(-1.0, &z.along(&axes[0]))]), sum([(-1.0, &turn)])];
        let mut shift = Vector3::zeros();
        let shifts: [Function; 3] = std::array::from_fn(|k| {
            let y = rotation * (anchors[k].value - centre);
            shift[k] = -y[k];
            let turned = columns(&y);
            let own = anchors[k].along(&axes[k]);
            sum([(-1.0, &own)].into_iter().chain((0..3).map(|j| (-turned[(k, j)], &w[j]))))
        });
        let [a, b, c] = w;
        let [d, e, f] = shifts;
        Self { centre, rotation, scale: 1.0, shift, by: [a, b, c, d, e, f, Function::new()] }
    }

    fn tell(&self, points: &Points, carry: Carry<'_>, result: &mut MeasuredSystem) -> Result<()> {
        result.rotation = std::array::from_fn(|i| std::array::from_fn(|j| self.rotation[(i, j)]));
        result.scale = self.scale;
        result.shift = (self.shift - self.scale * (self.rotation * self.centre)).into();
        let carried = carry(&self.by)?;
        let own = carried.as_ref().map(|carried| {
            SMatrix::<f64, PARAMETERS, PARAMETERS>::from_fn(|i, j| covariance(&self.by[i], &carried[j]))
        });
        let m = self.scale * self.rotation;
        for (number, point) in points.all.iter().enumerate() {
            let y = m * (points.at(number) - self.centre);
            let sigma = match (&carried, &own, point.covariance) {
                (Some(carried), Some(own), Some([xx, xy, xz, yy, yz, zz])) => {
                    let a = columns(&y);
                    let mixed = SMatrix::<f64, 3, PARAMETERS>::from_fn(|i, k| carried[k][number][i]);
                    let cross = m * mixed * a.transpose();
                    let covariance = m * Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz) * m.transpose()
                        + a * own * a.transpose()
                        + cross
                        + cross.transpose();
                    // What the system is laid through keeps only rounding of what cancels.
                    let least = 1e-12 * m.norm_squared() * (xx + yy + zz);
                    Some(std::array::from_fn(
                        |k| if covariance[(k, k)] < least { 0.0 } else { root(covariance[(k, k)]) },
                    ))
                }
                _ => None,
            };
            result.points.push(SystemPoint { id: point.id.clone(), xyz: (y + self.shift).into(), sigma });
        }
        Ok(())
    }
}
