//! What the photos of a camera cover: how far out in the picture targets were measured, and how the camera was turned and tilted.
//!
//! Distortion is only known where targets were measured; a principal point only where the camera was rolled about its axis (D. C. Brown,
//! Close-range camera calibration, 1971); a principal distance of a plane object only where it was tilted against the axis.

use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::error::Result;
use crate::project::Project;
use crate::rotation;

/// Cells of the picture across and down.
const CELLS: [usize; 2] = [8, 6];
/// Rings from the middle to the corner.
const RINGS: usize = 5;
/// Upper ends of the classes of tilts, degrees.
const TILTS: [f64; 3] = [15.0, 30.0, 45.0];
/// Minimum number of photos: with eight, the poses can be separated from the unknowns of a lens.
const PHOTOS: usize = 8;
/// A radius up to which targets have to be measured, in parts of that of the corner; the rest is extrapolated.
const REACH: f64 = 0.85;
/// Cells without a target, as a part of all, above which that is reported.
const EMPTY: f64 = 0.15;
/// Tilt of some photos without which the principal distance of a plane object cannot be separated from its distance, degrees.
const TILTED: f64 = 20.0;

/// Deficiency of the coverage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum CoverageLack {
    /// Photos: fewer than eight.
    Photos,
    /// Targets towards the corners.
    Radius,
    /// Targets in several parts of the picture.
    Cells,
    /// Photos rolled by 90 degrees about the axis.
    Roll,
    /// Photos tilted against the object.
    Tilt,
}

/// Coverage of the image by the targets of a camera's photos.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Coverage {
    /// Camera identifier.
    pub camera: String,
    /// Photos with measurements that take part.
    pub photos: usize,
    /// Their measurements.
    pub measurements: usize,
    /// Measurements by rows and columns of cells of the picture.
    pub cells: Vec<Vec<usize>>,
    /// Measurements by rings from the middle to the corner, all as wide.
    pub rings: Vec<usize>,
    /// Radius of the outermost measurement in parts of that of the corner.
    pub reach: f64,
    /// Photos with a known orientation: of these are rolls and tilts.
    pub oriented: usize,
    /// Photos by their roll about the axis against the first one: 0, 90, 180, 270 degrees, each within 45.
    pub rolls: [usize; 4],
    /// Photos by the tilt of their axis against the normal of the points' plane, in classes up to 15, 30, 45 and 90 degrees.
    pub tilts: [usize; 4],
    /// Smallest and largest distance from the points' centroid, in the project's unit; null without orientation.
    pub distances: Option<[f64; 2]>,
    /// Deficiencies of the coverage.
    pub lacks: Vec<CoverageLack>,
}

/// Coverage of the image by the targets of a camera's photos. Orientations and points are those of the document.
///
/// # Errors
/// As [`super::compare_models`] for the camera; whatever [`Project::validate`] finds.
pub fn coverage(project: &Project, camera: Option<&str>) -> Result<Coverage> {
    project.validate()?;
    let camera = super::camera_of(project, camera)?;
    let size = [f64::from(camera.width), f64::from(camera.height)];
    let corner = size[0].hypot(size[1]) / 2.0;
    let mut found = Coverage {
        camera: camera.id.clone(),
        cells: vec![vec![0; CELLS[0]]; CELLS[1]],
        rings: vec![0; RINGS],
        ..Coverage::default()
    };
    let own = project.photos.iter().filter(|p| p.enabled && p.camera == camera.id);
    let mut count: HashMap<&str, usize> = own.map(|p| (p.id.as_str(), 0)).collect();
    for o in project.observations.iter().filter(|o| o.enabled) {
        let Some(count) = count.get_mut(o.photo.as_str()) else { continue };
        *count += 1;
        found.measurements += 1;
        let at = |value: f64, size: f64, n: usize| ((value / size * n as f64).max(0.0) as usize).min(n - 1);
        found.cells[at(o.v, size[1], CELLS[1])][at(o.u, size[0], CELLS[0])] += 1;
        let radius = (o.u - size[0] / 2.0).hypot(o.v - size[1] / 2.0) / corner;
        found.rings[at(radius, 1.0, RINGS)] += 1;
        found.reach = found.reach.max(radius);
    }
    found.photos = count.values().filter(|n| **n > 0).count();
    let places: Vec<Vector3<f64>> = project.points.iter().filter_map(|p| p.xyz).map(Vector3::from).collect();
    let plane = BestFitPlane::of(&places);
    let taken = project.photos.iter().filter(|p| count.get(p.id.as_str()).is_some_and(|n| *n > 0));
    let mut first = None;
    let mut most_tilted = 0.0_f64;
    for (position, angles) in taken.filter_map(|p| p.position.zip(p.rotation)) {
        found.oriented += 1;
        let m = rotation::object_to_camera(angles);
        if let Some(plane) = &plane {
            let to_centre = (Vector3::from(position) - plane.centre).norm();
            let [near, far] = found.distances.unwrap_or([to_centre; 2]);
            found.distances = Some([near.min(to_centre), far.max(to_centre)]);
            // the camera looks along its -z
            let tilt = (m.row(2) * plane.normal)[0].abs().min(1.0).acos().to_degrees();
            most_tilted = most_tilted.max(tilt);
            found.tilts[TILTS.iter().filter(|end| tilt > **end).count()] += 1;
            let direction = m * plane.along;
            let roll = direction.y.atan2(direction.x);
            let against = (roll - *first.get_or_insert(roll)).rem_euclid(TAU);
            found.rolls[(against / FRAC_PI_2).round() as usize % 4] += 1;
        }
    }
    found.lacks = lacks(&found, most_tilted, plane.is_some_and(|plane| plane.is_flat));
    Ok(found)
}

fn lacks(found: &Coverage, most_tilted: f64, is_flat: bool) -> Vec<CoverageLack> {
    let empty = found.cells.iter().flatten().filter(|n| **n == 0).count() as f64;
    let known = found.oriented > 1;
    let all = [
        (CoverageLack::Photos, found.photos < PHOTOS),
        (CoverageLack::Radius, found.measurements > 0 && found.reach < REACH),
        (CoverageLack::Cells, found.measurements > 0 && empty > EMPTY * (CELLS[0] * CELLS[1]) as f64),
        (CoverageLack::Roll, known && found.rolls[1] + found.rolls[3] == 0),
        (CoverageLack::Tilt, known && is_flat && most_tilted < TILTED),
    ];
    all.into_iter().filter_map(|(lack, missing)| missing.then_some(lack)).collect()
}

/// The plane that the points lie nearest to.
struct BestFitPlane {
    centre: Vector3<f64>,
    normal: Vector3<f64>,
    /// The points' longest extent.
    along: Vector3<f64>,
    /// Whether they reach less than a tenth as far out of it as along it.
    is_flat: bool,
}

impl BestFitPlane {
    fn of(places: &[Vector3<f64>]) -> Option<Self> {
        if places.len() < 3 {
            return None;
        }
        let centre = places.iter().sum::<Vector3<f64>>() / places.len() as f64;
        let spread: Matrix3<f64> = places.iter().map(|x| (x - centre) * (x - centre).transpose()).sum();
        let eigen = spread.symmetric_eigen();
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let axis = |k: usize| eigen.eigenvectors.column(order[k]).into_owned();
        let is_flat = eigen.eigenvalues[order[0]] < 0.01 * eigen.eigenvalues[order[2]];
        Some(Self { centre, normal: axis(0), along: axis(2), is_flat })
    }
}
