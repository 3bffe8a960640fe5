//! Initial values: closed-form and linear solutions, each refined by least squares where its documentation states it.
//!
//! Image points are given in the form each function names: *ideal coordinates* are distortion-free and divided by the
//! principal distance, so that (x, y, -1) is the ray in the camera frame; *photo coordinates* are x right, y up in
//! photo units. Names are not used here: a failure is a [`Degeneracy`], which the caller relates to its
//! photos and points.

pub mod dlt;
pub mod essential;
pub mod homography;
pub mod intersection;
pub mod p3p;
pub mod polynomial;
pub mod pose;
pub mod pose_from_rays;
pub mod relative;
pub mod resection;
pub mod robust;
pub mod similarity;

use nalgebra::{Matrix3, Vector3};

pub use crate::error::Degeneracy;
pub use pose::Pose;

/// Centroid and principal axes of a set of points; they decide whether it spans a volume, a plane or a line.
#[derive(Clone, Copy, Debug)]
pub struct PrincipalAxes {
    /// Mean of the points.
    pub centroid: Vector3<f64>,
    /// Unit principal axes as columns, longest extent first, right-handed.
    pub axes: Matrix3<f64>,
    /// Root mean square extents along the axes, descending.
    pub extent: Vector3<f64>,
}

/// Extent ratio below which a direction counts as missing in a set given without noise of its own.
pub(crate) const FLAT: f64 = 1e-6;

impl PrincipalAxes {
    /// Principal axes of the points' scatter about their centroid.
    ///
    /// # Errors
    /// [`Degeneracy::TooFew`] without points.
    pub fn of(points: &[Vector3<f64>]) -> Result<Self, Degeneracy> {
        if points.is_empty() {
            return Err(Degeneracy::TooFew { needed: 1, given: 0 });
        }
        let n = points.len() as f64;
        let centroid = points.iter().sum::<Vector3<f64>>() / n;
        // The scatter is formed from coordinates reduced to the centroid and by the largest of them, so that object
        // coordinates of any size and unit keep their digits.
        let scale = points.iter().map(|p| (p - centroid).amax()).fold(0.0, f64::max);
        if scale <= 0.0 {
            return Ok(Self { centroid, axes: Matrix3::identity(), extent: Vector3::zeros() });
        }
        let mut scatter = Matrix3::zeros();
        for p in points {
            let d = (p - centroid) / scale;
            scatter += d * d.transpose();
        }
        let eigen = (scatter / n).symmetric_eigen();
        let mut order = [0, 1, 2];
        order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
        let column = |k: usize| eigen.eigenvectors.column(order[k]).into_owned();
        let axes = Matrix3::from_columns(&[column(0), column(1), column(0).cross(&column(1))]);
        // The smallest eigenvalue of a flat set is rounding of the largest: its extent is measured, not taken from it.
        let along =
            |axis: Vector3<f64>| (points.iter().map(|p| (p - centroid).dot(&axis).powi(2)).sum::<f64>() / n).sqrt();
        let extent = Vector3::new(along(column(0)), along(column(1)), along(axes.column(2).into_owned()));
        Ok(Self { centroid, axes, extent })
    }

    /// Whether the points lie on a line or coincide.
    pub fn is_line(&self) -> bool {
        self.extent[1] <= FLAT * self.extent[0]
    }

    /// Whether the points lie in a plane (or on a line).
    pub fn is_plane(&self) -> bool {
        self.extent[2] <= FLAT * self.extent[0]
    }
}
