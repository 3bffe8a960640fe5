//! Plane homography: a plane object against its image, the pose it implies, and the principal distance.
//!
//! Normalised direct linear solution (Hartley and Zisserman, Multiple View Geometry, 4.4); pose and principal distance
//! from the orthonormality of the first two columns of M (Zhang 2000).

use nalgebra::{DMatrix, Matrix3, Vector3};

use super::{Degeneracy, Pose, PrincipalAxes};
use crate::rotation;

/// A homography between the plane of object points and the photo.
#[derive(Clone, Copy, Debug)]
pub struct PlaneHomography {
    /// Plane to image: (x, y, 1)ᵀ ~ H·(s, t, 1)ᵀ with (s, t) along the first two axes of `plane`, divided by `unit`.
    pub matrix: Matrix3<f64>,
    /// The plane: centroid and axes of the object points.
    pub plane: PrincipalAxes,
    /// Object length that (s, t) are counted in.
    pub unit: f64,
}

/// The homography H with to ~ H·from, of unit norm, by normalised direct linear solution.
///
/// # Errors
/// [`Degeneracy::TooFew`] below four points; [`Degeneracy::Collinear`] if they do not span the plane.
pub fn homography(from: &[[f64; 2]], to: &[[f64; 2]]) -> Result<Matrix3<f64>, Degeneracy> {
    let n = from.len().min(to.len());
    if n < 4 {
        return Err(Degeneracy::TooFew { needed: 4, given: n });
    }
    let (t_from, t_to) = (normalising(&from[..n])?, normalising(&to[..n])?);
    let mut design = DMatrix::<f64>::zeros(2 * n.max(5), 9);
    for k in 0..n {
        let a = t_from * Vector3::new(from[k][0], from[k][1], 1.0);
        let b = t_to * Vector3::new(to[k][0], to[k][1], 1.0);
        for j in 0..3 {
            design[(2 * k, j)] = a[j];
            design[(2 * k, 6 + j)] = -b[0] * a[j];
            design[(2 * k + 1, 3 + j)] = a[j];
            design[(2 * k + 1, 6 + j)] = -b[1] * a[j];
        }
    }
    let svd = design.svd(false, true);
    let v_t = svd.v_t.ok_or(Degeneracy::NoSolution)?;
    if svd.singular_values[7] < 1e-9 * svd.singular_values[0] {
        return Err(Degeneracy::Collinear);
    }
    let h = v_t.row(8);
    let normalised = Matrix3::new(h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], h[8]);
    let back = t_to.try_inverse().ok_or(Degeneracy::Collinear)?;
    let matrix = back * normalised * t_from;
    let norm = matrix.norm();
    if norm > 0.0 && norm.is_finite() { Ok(matrix / norm) } else { Err(Degeneracy::NoSolution) }
}

/// Shift to the centroid and scale to a mean distance of √2.
pub(super) fn normalising(points: &[[f64; 2]]) -> Result<Matrix3<f64>, Degeneracy> {
    let n = points.len() as f64;
    let mean = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n);
    let distance = points.iter().map(|p| (p[0] - mean[0]).hypot(p[1] - mean[1])).sum::<f64>() / n;
    if !(distance > 0.0) || !distance.is_finite() {
        return Err(Degeneracy::Collinear);
    }
    let s = std::f64::consts::SQRT_2 / distance;
    Ok(Matrix3::new(s, 0.0, -s * mean[0], 0.0, s, -s * mean[1], 0.0, 0.0, 1.0))
}

/// The homography of object points that lie in (or near) a plane to their image, in ideal or photo coordinates.
///
/// # Errors
/// As [`homography`].
pub fn of_plane(object: &[Vector3<f64>], image: &[[f64; 2]]) -> Result<PlaneHomography, Degeneracy> {
    let plane = PrincipalAxes::of(object)?;
    if plane.is_line() {
        return Err(Degeneracy::Collinear);
    }
    let unit = plane.extent[0];
    let flat: Vec<[f64; 2]> = object
        .iter()
        .map(|p| {
            let d = plane.axes.tr_mul(&(p - plane.centroid)) / unit;
            [d.x, d.y]
        })
        .collect();
    Ok(PlaneHomography { matrix: homography(&flat, image)?, plane, unit })
}

impl PlaneHomography {
    /// The pose, for an image in ideal coordinates: the columns of H are, up to a factor, the first two of
    /// diag(-1, -1, 1)·M and the translation.
    ///
    /// # Errors
    /// [`Degeneracy::NoSolution`] if the plane is seen edge-on.
    pub fn pose(&self) -> Result<Pose, Degeneracy> {
        let flip = Matrix3::from_diagonal(&Vector3::new(-1.0, -1.0, 1.0));
        let h = flip * self.matrix;
        let (h1, h2, h3) = (h.column(0), h.column(1), h.column(2));
        let size = (h1.norm() * h2.norm()).sqrt();
        // The plane's origin is in front: its z in the camera frame is negative.
        let lambda = -h3.z.signum() / size;
        if !lambda.is_finite() {
            return Err(Degeneracy::NoSolution);
        }
        let (first, second) = (h1 * lambda, h2 * lambda);
        let m = rotation::nearest(&Matrix3::from_columns(&[first, second, first.cross(&second)]));
        let object_to_camera = m * self.plane.axes.transpose();
        let origin = h3 * lambda * self.unit;
        Ok(Pose { object_to_camera, centre: self.plane.centroid - object_to_camera.tr_mul(&origin) })
    }
}

/// The principal distance that makes all planes' homographies those of rotations, for images in photo coordinates
/// about the principal point; `None` if every plane is parallel to its photo, which leaves it undetermined.
///
/// With w = 1/c², each homography gives (h₁₁h₁₂ + h₂₁h₂₂)·w + h₃₁h₃₂ = 0 and
/// (h₁₁² + h₂₁² - h₁₂² - h₂₂²)·w + h₃₁² - h₃₂² = 0; least squares over all of them.
pub fn principal_distance(planes: &[PlaneHomography]) -> Option<f64> {
    let (mut squares, mut products) = (0.0, 0.0);
    for plane in planes {
        let h = plane.matrix;
        // One scale for all photos: the plane's unit length as seen in the image.
        let size = (h[(0, 0)] * h[(1, 1)] - h[(0, 1)] * h[(1, 0)]).abs();
        if !(size > 0.0) {
            continue;
        }
        let equations = [
            (h[(0, 0)] * h[(0, 1)] + h[(1, 0)] * h[(1, 1)], h[(2, 0)] * h[(2, 1)]),
            (
                h[(0, 0)].powi(2) + h[(1, 0)].powi(2) - h[(0, 1)].powi(2) - h[(1, 1)].powi(2),
                h[(2, 0)].powi(2) - h[(2, 1)].powi(2),
            ),
        ];
        for (a, b) in equations {
            squares += (a / size).powi(2);
            products -= a * b / (size * size);
        }
    }
    let w = products / squares;
    (w > 0.0 && w.is_finite()).then(|| 1.0 / w.sqrt()).filter(|c| c.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rotation::object_to_camera;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn sheet() -> Vec<Vector3<f64>> {
        let turn = object_to_camera([0.4, 0.2, 0.1]);
        (0..9)
            .map(|k| {
                turn * Vector3::new(f64::from(k % 3) * 0.4, f64::from(k / 3) * 0.5, 0.0) + Vector3::new(50.0, 9.0, 2.0)
            })
            .collect()
    }

    fn photo(angles: [f64; 3], distance: f64) -> Pose {
        let m = object_to_camera(angles);
        let centre =
            PrincipalAxes::of(&sheet()).expect("points").centroid + m.tr_mul(&Vector3::new(0.1, 0.0, distance));
        Pose { object_to_camera: m, centre }
    }

    #[test]
    fn the_pose_of_a_plane_is_exact() {
        for angles in [[0.4, 0.2, 0.1], [0.9, -0.3, 2.0], [-0.4, 0.6, -1.0]] {
            let truth = photo(angles, 3.0);
            let image: Vec<_> = sheet().iter().map(|p| truth.image(p).expect("in front")).collect();
            let pose = of_plane(&sheet(), &image).and_then(|h| h.pose()).expect("a plane");
            assert!((pose.centre - truth.centre).norm() < 1e-9, "{angles:?}");
            assert!((pose.object_to_camera - truth.object_to_camera).norm() < 1e-9);
        }
    }

    #[test]
    fn tilted_planes_give_the_principal_distance_and_parallel_ones_do_not() {
        let seen = |angles: [f64; 3]| {
            let image: Vec<_> =
                sheet().iter().map(|p| photo(angles, 3.0).image(p).expect("in front").map(|x| 7.5 * x)).collect();
            of_plane(&sheet(), &image).expect("a plane")
        };
        let c = principal_distance(&[seen([0.9, 0.2, 0.1]), seen([0.2, -0.3, 1.0])]).expect("tilted");
        assert!((c - 7.5).abs() < 1e-8, "{c}");
        let turned_back = rotation::angles(&object_to_camera([0.4, 0.2, 0.1]).transpose());
        let parallel = principal_distance(&[seen(turned_back)]);
        assert!(parallel.is_none_or(|c| c > 1e4), "{parallel:?}");
    }

    #[test]
    fn points_on_a_line_are_refused() {
        let line: Vec<[f64; 2]> = (0..5).map(|k| [f64::from(k), 2.0 * f64::from(k)]).collect();
        assert_eq!(homography(&line, &line).unwrap_err(), Degeneracy::Collinear);
        assert_eq!(homography(&line[..3], &line[..3]).unwrap_err(), Degeneracy::TooFew { needed: 4, given: 3 });
    }
}
