//! Rendered photos of targets, for tests, the sample and planning.
//!
//! Targets are exact ([`coverage`]): their outlines are projected with perspective and distortion and integrated over
//! box pixels blurred by a Gaussian point spread. Ground, vignetting and noise follow; nothing of it is random but by
//! the seed.

mod coverage;
mod ground;

use crate::reason::PlanReason;
use std::f64::consts::TAU;

use image::ImageEncoder;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::scene::{Disc, Ring, Scene};
use sightline::camera::{Model, pixel_from_camera_point};
use sightline::error::{Error, Place, Result};
use sightline::exif::{self, PhotoInfo};
use sightline::image::{Grey, Samples, SamplesView};
use sightline::initial::Pose;
use sightline::noise::Noise;
use sightline::project::Camera;

use coverage::{Coverage, MAX_NODES, Node, coverage, polygon, smooth};

/// How a photo is exposed. Greys are shares of full scale.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Exposure {
    /// Standard deviation of the Gaussian point spread, pixels.
    pub psf: f64,
    /// Share of the light lost in the corners.
    pub vignetting: f64,
    /// Standard deviation of the noise in the dark.
    pub read_noise: f64,
    /// Standard deviation that full scale adds to it; grows with the square root of the grey.
    pub shot_noise: f64,
    /// Bits of a sample, 8 or 16.
    pub bits: u32,
    /// Seed of the noise.
    pub seed: u64,
}

impl Default for Exposure {
    fn default() -> Self {
        Self { psf: 0.7, vignetting: 0.2, read_noise: 0.004, shot_noise: 0.01, bits: 8, seed: 1 }
    }
}

/// Outline nodes are this many point spreads apart; the integral is exact to rounding well before 0.5.
const NODE_SPACING: f64 = 0.35;

/// Renders a photo. `stream` keeps the noise of several photos of one seed apart.
///
/// Targets that are turned away, behind the camera, hidden by a face or not in the picture are left out.
///
/// # Errors
/// [`Error::Invalid`] for a scene or exposure that cannot be drawn; [`Error::MissingInitialValues`] without a principal
/// distance; [`Error::ImageSize`].
pub fn render(camera: &Camera, pose: &Pose, scene: &Scene, exposure: &Exposure, stream: u64) -> Result<Grey> {
    check(camera, exposure)?;
    scene.check()?;
    let (width, height) = (camera.width as usize, camera.height as usize);
    let mut greys = ground::ground(camera, pose, scene, exposure.psf);
    for disc in &scene.discs {
        for (filled, from, to) in layers(camera, pose, scene, disc, exposure.psf) {
            blend(&mut greys, width, &filled, from, to as f32);
        }
    }
    let samples = expose(&greys, width, exposure, stream);
    Ok(Grey { width, height, samples })
}

/// The picture as a PNG file, with EXIF data of the camera.
///
/// # Errors
/// [`Error::Invalid`] if the number of samples does not fit the size.
pub fn png(picture: &Grey, info: Option<&PhotoInfo>) -> Result<Vec<u8>> {
    let mut file = Vec::new();
    let mut encoder = PngEncoder::new_with_quality(&mut file, CompressionType::Fast, FilterType::Up);
    let failed = |message: String| Error::Invalid {
        reason: PlanReason::CannotWritePicture { message }.into(),
        at: Place::default(),
    };
    if let Some(info) = info {
        encoder.set_exif_metadata(exif::write(info)).map_err(|error| failed(error.to_string()))?;
    }
    let (width, height) = (picture.width as u32, picture.height as u32);
    let written = match picture.view()?.samples() {
        SamplesView::U8(samples) => encoder.write_image(samples, width, height, image::ExtendedColorType::L8),
        SamplesView::U16(samples) => {
            let bytes: Vec<u8> = samples.iter().flat_map(|s| s.to_ne_bytes()).collect();
            encoder.write_image(&bytes, width, height, image::ExtendedColorType::L16)
        }
    };
    written.map_err(|error| failed(error.to_string()))?;
    Ok(file)
}

/// Whether a target faces the camera, is in front of it and not hidden.
fn shows(pose: &Pose, scene: &Scene, disc: &Disc) -> bool {
    let centre = Vector3::from(disc.centre);
    let faces_us = Vector3::from(disc.normal).dot(&(pose.centre - centre)) > 0.0;
    faces_us && pose.to_camera(&centre).z < 0.0 && !scene.hides(&pose.centre, &centre)
}

/// Shapes of a target from the ground up: coverage, the grey it replaces (none: whatever is there), its own grey.
fn layers(camera: &Camera, pose: &Pose, scene: &Scene, disc: &Disc, psf: f64) -> Vec<(Coverage, Option<f64>, f64)> {
    if !shows(pose, scene, disc) {
        return Vec::new();
    }
    let plane = Plane::new(camera, pose, disc);
    let radius = disc.diameter / 2.0;
    let spacing = NODE_SPACING * psf;
    let circle = |r: f64| smooth(|t| plane.image([r * t.cos(), r * t.sin()]), spacing);
    let mut outlines = Vec::new();
    if let Some(patch) = disc.patch {
        outlines.push((circle(radius * patch.ratio), None, patch.grey));
    }
    let under = disc.patch.map(|patch| patch.grey);
    outlines.push((circle(radius), under, disc.grey));
    if let Some(ring) = disc.ring {
        let per_unit = plane.scale().unwrap_or(1.0);
        let radii = ring.design.ring().map(|r| r * radius);
        let sectors = sectors(ring).map(|turn| plane.sector(turn, radii, spacing / per_unit));
        outlines.extend(sectors.map(|nodes| (nodes, under, disc.grey)));
        let spot = ring.design.spot();
        if let (true, Some(ground)) = (spot > 0.0, under) {
            outlines.push((circle(spot * radius), Some(disc.grey), ground));
        }
    }
    let drawable = |nodes: Option<Vec<Node>>| {
        nodes.filter(|nodes| nodes.iter().any(|n| inside(camera, n)) && nodes.iter().all(|n| near(camera, n)))
    };
    let size = [camera.width as usize, camera.height as usize];
    let drawn =
        outlines.into_iter().filter_map(|(nodes, from, to)| Some((coverage(&drawable(nodes)?, psf, size), from, to)));
    drawn.collect()
}

fn inside(camera: &Camera, n: &Node) -> bool {
    n.u > 0.0 && n.v > 0.0 && n.u < f64::from(camera.width) && n.v < f64::from(camera.height)
}

/// Outlines that extend beyond the picture by more than its size are rejected.
fn near(camera: &Camera, n: &Node) -> bool {
    let margin = f64::from(camera.width.max(camera.height));
    n.u.abs() < 2.0 * margin && n.v.abs() < 2.0 * margin
}

/// The plane of a target with its images.
struct Plane<'a> {
    camera: &'a Camera,
    /// Centre and two unit directions in the camera frame, counterclockwise as seen.
    axes: [Vector3<f64>; 3],
}

impl<'a> Plane<'a> {
    fn new(camera: &'a Camera, pose: &Pose, disc: &Disc) -> Self {
        let normal = Vector3::from(disc.normal).normalize();
        let smallest = normal.iamin();
        let e1 = normal.cross(&Vector3::ith(smallest, 1.0)).normalize();
        let e2 = normal.cross(&e1);
        let m = pose.object_to_camera;
        Self { camera, axes: [pose.to_camera(&Vector3::from(disc.centre)), m * e1, m * e2] }
    }

    fn image(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        pixel_from_camera_point(self.camera, self.axes[0] + x * self.axes[1] + y * self.axes[2])
    }

    /// Pixels per unit length at the centre, roughly.
    fn scale(&self) -> Option<f64> {
        let step = self.axes[0].norm() * 1e-4;
        let (p, q) = (self.image([0.0, 0.0])?, self.image([step, 0.0])?);
        Some(((p[0] - q[0]).hypot(p[1] - q[1]) / step).max(1e-6))
    }

    /// Outline of a ring sector between two turns (0 to 1, clockwise as seen) and two radii.
    fn sector(&self, [start, end]: [f64; 2], [inner, outer]: [f64; 2], spacing: f64) -> Option<Vec<Node>> {
        let polar = |r: f64, turn: f64| self.image([r * (TAU * turn).cos(), -r * (TAU * turn).sin()]);
        let arc = |r: f64| ((end - start) * TAU * r / spacing).ceil().max(8.0) as usize;
        let side = ((outer - inner) / spacing).ceil().max(4.0) as usize;
        let (far, close) = (arc(outer), arc(inner));
        if far.max(close).max(side) > MAX_NODES / 8 {
            return None;
        }
        let share = |k: usize, n: usize| k as f64 / n as f64;
        let outer_arc = (0..far).map(|k| polar(outer, start + (end - start) * share(k, far)));
        let inwards = (0..side).map(|k| polar(outer + (inner - outer) * share(k, side), end));
        let inner_arc = (0..close).map(|k| polar(inner, end + (start - end) * share(k, close)));
        let outwards = (0..side).map(|k| polar(inner + (outer - inner) * share(k, side), start));
        let vertices: Option<Vec<_>> = outer_arc.chain(inwards).chain(inner_arc).chain(outwards).collect();
        vertices.map(|vertices| polygon(&vertices))
    }
}

/// Start and end of each set sector, in turns.
fn sectors(ring: Ring) -> impl Iterator<Item = [f64; 2]> {
    let n = ring.sectors;
    let set = move |k: &u32| ring.code >> (n - 1 - k) & 1 == 1;
    (0..n).filter(set).map(move |k| [f64::from(k) / f64::from(n), f64::from(k + 1) / f64::from(n)])
}

/// Paints a shape. On a known grey the difference is added, which is exact for shapes within their ground.
fn blend(greys: &mut [f32], width: usize, filled: &Coverage, from: Option<f64>, to: f32) {
    for (row, line) in filled.shares.chunks_exact(filled.columns).enumerate() {
        let begin = (filled.top + row) * width + filled.left;
        for (grey, share) in greys[begin..].iter_mut().zip(line) {
            *grey += *share as f32 * (to - from.map_or(*grey, |from| from as f32));
        }
    }
}

/// Vignetting, noise and rounding to samples.
fn expose(greys: &[f32], width: usize, exposure: &Exposure, stream: u64) -> Samples {
    let mut noise = Noise::new(exposure.seed, stream);
    let height = greys.len() / width;
    let (middle_u, middle_v) = (width as f64 / 2.0, height as f64 / 2.0);
    let corner = middle_u * middle_u + middle_v * middle_v;
    let (read, shot) = (exposure.read_noise.powi(2), exposure.shot_noise.powi(2));
    let full = f64::from((1u32 << exposure.bits) - 1);
    let levels = greys.iter().enumerate().map(|(i, grey)| {
        let (u, v) = ((i % width) as f64 + 0.5 - middle_u, (i / width) as f64 + 0.5 - middle_v);
        let light = f64::from(*grey) * (1.0 - exposure.vignetting * (u * u + v * v) / corner);
        let variance = read + shot * light.max(0.0);
        let noisy = if variance > 0.0 { light + variance.sqrt() * noise.normal() } else { light };
        (noisy * full).round().clamp(0.0, full)
    });
    if exposure.bits == 16 {
        Samples::U16(levels.map(|l| l as u16).collect())
    } else {
        Samples::U8(levels.map(|l| l as u8).collect())
    }
}

fn check(camera: &Camera, exposure: &Exposure) -> Result<()> {
    let pixels = u64::from(camera.width) * u64::from(camera.height);
    if pixels == 0 || pixels > sightline::decode::PIXEL_LIMIT {
        return Err(Error::ImageSize {
            width: camera.width.into(),
            height: camera.height.into(),
            limit: sightline::decode::PIXEL_LIMIT,
            at: Place::camera(&camera.id),
        });
    }
    if Model::new(&camera.interior).is_none() {
        return Err(Error::MissingInitialValues {
            photos: Vec::new(),
            points: Vec::new(),
            cameras: vec![camera.id.clone()],
        });
    }
    let shares = [exposure.vignetting, exposure.read_noise, exposure.shot_noise];
    let in_range = shares.iter().all(|s| (0.0..=1.0).contains(s)) && (0.3..=10.0).contains(&exposure.psf);
    if !in_range || !matches!(exposure.bits, 8 | 16) {
        return Err(Error::Invalid { reason: PlanReason::Exposure.into(), at: Place::field("exposure") });
    }
    Ok(())
}

#[cfg(test)]
mod tests;
