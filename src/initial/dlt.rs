//! Direct linear transformation: interior and exterior orientation from six or more points of a volume.
//!
//! Kim, Hwang and Yun (2015), equations 5-8, after Abdel-Aziz and Karara (1971):
//! x = (L₁X + L₂Y + L₃Z + L₄)/(L₉X + L₁₀Y + L₁₁Z + 1), y = (L₅X + L₆Y + L₇Z + L₈)/(L₉X + L₁₀Y + L₁₁Z + 1).
//! Solved homogeneously in normalised coordinates (Hartley and Zisserman, 7.1), so that neither the size of the
//! coordinates nor a denominator near zero at the origin costs digits.

use nalgebra::{DMatrix, Matrix3, Matrix3x4, Matrix4, SMatrix, Vector3};

use super::homography::normalising;
use super::{Degeneracy, Pose, PrincipalAxes};
use crate::rotation;

/// A photo's interior and exterior orientation by direct linear transformation. Photo units.
#[derive(Clone, Copy, Debug)]
pub struct Dlt {
    /// Object to photo coordinates, homogeneous, in coordinates reduced by `origin`; unit norm.
    pub projection: Matrix3x4<f64>,
    /// Object point that the projection's coordinates are reduced by.
    pub origin: Vector3<f64>,
    /// Principal point, x.
    pub x0: f64,
    /// Principal point, y.
    pub y0: f64,
    /// Principal distance in x.
    pub cx: f64,
    /// Principal distance in y.
    pub cy: f64,
    /// Share of the camera's y in the photo's x (0 for a sensor with rectangular pixels).
    pub skew: f64,
    /// M and XL.
    pub pose: Pose,
    /// Root mean square of the residuals, per coordinate.
    pub rms: f64,
}

impl Dlt {
    /// The eleven parameters L₁ … L₁₁ about the true origin; `None` if the origin lies in the plane through the
    /// projection centre parallel to the photo, which makes the denominator 0 there.
    pub fn parameters(&self) -> Option<[f64; 11]> {
        let mut p = self.projection;
        let last = p.column(3) - p.fixed_columns::<3>(0) * self.origin;
        p.set_column(3, &last);
        let l = p / p[(2, 3)];
        let row_by_row = l.transpose();
        let mut parameters = [0.0; 11];
        parameters.copy_from_slice(&row_by_row.as_slice()[..11]);
        parameters.iter().all(|value| value.is_finite()).then_some(parameters)
    }
}

/// The direct linear transformation from object points to photo coordinates, decomposed.
///
/// # Errors
/// [`Degeneracy::TooFew`] below six points; [`Degeneracy::Coplanar`] (or `Collinear`) when the points leave the
/// eleven parameters undetermined, or determine them by their noise only;
/// [`Degeneracy::NoSolution`] if the result is not a camera: points on both sides of it, or a mirrored photo.
pub fn dlt(object: &[Vector3<f64>], image: &[[f64; 2]]) -> Result<Dlt, Degeneracy> {
    let n = object.len().min(image.len());
    if n < 6 {
        return Err(Degeneracy::TooFew { needed: 6, given: n });
    }
    let (object, image) = (&object[..n], &image[..n]);
    let spread = PrincipalAxes::of(object)?;
    if spread.is_line() {
        return Err(Degeneracy::Collinear);
    }
    if spread.is_plane() {
        return Err(Degeneracy::Coplanar);
    }
    let size = spread.extent.norm() / 3f64.sqrt();
    let normalised = homogeneous(object, image, &spread, size)?;
    let back = normalising(image)?.try_inverse().ok_or(Degeneracy::Collinear)?;
    let mut reduce = Matrix4::identity() / size;
    reduce[(3, 3)] = 1.0;
    let projection = back * normalised * reduce;
    let projection = projection / projection.norm();
    decomposed(projection, spread.centroid, object, image)
}

/// The null vector of the 2n x 12 design matrix in normalised coordinates.
fn homogeneous(
    object: &[Vector3<f64>],
    image: &[[f64; 2]],
    spread: &PrincipalAxes,
    size: f64,
) -> Result<Matrix3x4<f64>, Degeneracy> {
    let shrink = normalising(image)?;
    let mut design = DMatrix::<f64>::zeros(2 * object.len(), 12);
    for (k, (p, m)) in object.iter().zip(image).enumerate() {
        let a = ((p - spread.centroid) / size).push(1.0);
        let b = shrink * Vector3::new(m[0], m[1], 1.0);
        for j in 0..4 {
            design[(2 * k, j)] = a[j];
            design[(2 * k, 8 + j)] = -b[0] * a[j];
            design[(2 * k + 1, 4 + j)] = a[j];
            design[(2 * k + 1, 8 + j)] = -b[1] * a[j];
        }
    }
    let svd = design.svd(false, true);
    let (v_t, s) = (svd.v_t.ok_or(Degeneracy::NoSolution)?, svd.singular_values);
    // A second direction nearly as weak as the solution's own residual: noise decides, the points are a plane to it.
    if s[10] < 1e-9 * s[0] || s[10] < 4.0 * s[11] {
        return Err(Degeneracy::Coplanar);
    }
    Ok(Matrix3x4::from_fn(|i, j| v_t[(11, 4 * i + j)]))
}

/// K' and M from the projection's left part A = λK'M, with K' = [[-cx, s, x0], [0, -cy, y0], [0, 0, 1]]: the third row
/// of A is λm₃, and λ's sign puts the points at negative z.
fn decomposed(
    projection: Matrix3x4<f64>,
    origin: Vector3<f64>,
    object: &[Vector3<f64>],
    image: &[[f64; 2]],
) -> Result<Dlt, Degeneracy> {
    let left: SMatrix<f64, 3, 3> = projection.fixed_columns::<3>(0).into_owned();
    let row = |k: usize| left.row(k).transpose();
    let depth = |p: &Vector3<f64>| (projection.row(2) * (p - origin).push(1.0)).x;
    let in_front = object.iter().filter(|p| depth(p) < 0.0).count();
    let sign = if in_front == object.len() {
        1.0
    } else if in_front == 0 {
        -1.0
    } else {
        return Err(Degeneracy::NoSolution);
    };
    let lambda = sign * row(2).norm();
    let m3 = row(2) / lambda;
    let (a1, a2) = (row(0) / lambda, row(1) / lambda);
    let (x0, y0) = (a1.dot(&m3), a2.dot(&m3));
    let second = y0 * m3 - a2;
    let cy = second.norm();
    let m2 = second / cy;
    let m1 = m2.cross(&m3);
    let first = a1 - x0 * m3;
    let (cx, skew) = (-first.dot(&m1), first.dot(&m2));
    let inverse = left.try_inverse().ok_or(Degeneracy::Coplanar)?;
    let centre = origin - inverse * projection.column(3);
    if !(cx > 0.0 && cy > 0.0 && centre.iter().all(|c| c.is_finite())) {
        return Err(Degeneracy::NoSolution);
    }
    let m = rotation::nearest(&Matrix3::from_rows(&[m1.transpose(), m2.transpose(), m3.transpose()]));
    let squares: f64 = object
        .iter()
        .zip(image)
        .map(|(p, [x, y])| {
            let q = projection * (p - origin).push(1.0);
            (q.x / q.z - x).powi(2) + (q.y / q.z - y).powi(2)
        })
        .sum();
    let rms = (squares / (2 * object.len()) as f64).sqrt();
    Ok(Dlt { projection, origin, x0, y0, cx, cy, skew, pose: Pose { object_to_camera: m, centre }, rms })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::initial::robust::{generator, uniform};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn scene(flat: f64) -> (Vec<Vector3<f64>>, Pose) {
        let mut g = generator(8);
        let centre = Vector3::new(999_600.0, 112_300.0, 140.0);
        let object = (0..12)
            .map(|_| {
                let mut next = || 400.0 * (uniform(&mut g) - 0.5);
                centre + Vector3::new(next(), next(), flat * next())
            })
            .collect();
        let m = rotation::object_to_camera([0.5, -0.3, 1.9]);
        (object, Pose { object_to_camera: m, centre: centre + m.tr_mul(&Vector3::new(20.0, 30.0, 900.0)) })
    }

    fn photograph(object: &[Vector3<f64>], pose: &Pose) -> Vec<[f64; 2]> {
        object
            .iter()
            .map(|p| {
                let [x, y] = pose.image(p).expect("in front");
                [0.4 + 120.0 * x, -0.7 + 121.0 * y]
            })
            .collect()
    }

    #[test]
    fn interior_and_exterior_orientation_come_back_from_large_coordinates() {
        let (object, pose) = scene(0.5);
        let image = photograph(&object, &pose);
        let found = dlt(&object, &image).expect("a volume");
        for (value, truth) in
            [(found.x0, 0.4), (found.y0, -0.7), (found.cx, 120.0), (found.cy, 121.0), (found.skew, 0.0)]
        {
            assert!((value - truth).abs() < 1e-6, "{value} for {truth}");
        }
        assert!((found.pose.centre - pose.centre).norm() < 1e-5);
        assert!((found.pose.object_to_camera - pose.object_to_camera).norm() < 1e-8);
        let l = found.parameters().expect("the origin is not in the focal plane");
        let p = object[3];
        let below = l[8] * p.x + l[9] * p.y + l[10] * p.z + 1.0;
        assert!(((l[0] * p.x + l[1] * p.y + l[2] * p.z + l[3]) / below - image[3][0]).abs() < 1e-4);
    }

    #[test]
    fn planes_are_recognised_exactly_and_through_their_noise() {
        for (flat, noise) in [(0.0, 0.0), (1e-5, 0.02)] {
            let (object, pose) = scene(flat);
            let mut g = generator(1);
            let image: Vec<[f64; 2]> =
                photograph(&object, &pose).iter().map(|m| m.map(|x| x + noise * (uniform(&mut g) - 0.5))).collect();
            assert_eq!(dlt(&object, &image).unwrap_err(), Degeneracy::Coplanar);
        }
    }

    #[test]
    fn a_mirrored_photo_is_no_camera() {
        let (object, pose) = scene(0.5);
        let image: Vec<[f64; 2]> = photograph(&object, &pose).iter().map(|[x, y]| [-x, *y]).collect();
        assert_eq!(dlt(&object, &image).unwrap_err(), Degeneracy::NoSolution);
        assert_eq!(dlt(&object[..5], &image[..5]).unwrap_err(), Degeneracy::TooFew { needed: 6, given: 5 });
    }
}
