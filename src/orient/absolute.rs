//! From the model's own system to the object's: control points, else distances for the scale and a system that lies in
//! the object.

use nalgebra::{Matrix3, Vector3};

use super::block::{BlockPoint, OrientationBlock};
use super::bridge;
use crate::initial::robust::quantile;
use crate::initial::similarity::{Similarity, fit_robust};
use crate::initial::{Pose, PrincipalAxes};
use crate::project::{Distance, Project};

/// Tolerances of a measurement within which points of two models agree: both are extrapolated.
const WIDE: f64 = 20.0;

/// Source of the coordinate system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum DatumSource {
    /// Points with given coordinates.
    Known,
    /// Given orientations of photos.
    GivenPhotos,
    /// The object's own plane.
    Own,
}

/// Moves the block into the system of the known points it holds; false with fewer than three, or only ones on a line.
pub(super) fn to_known(block: &mut OrientationBlock) -> bool {
    let with_both = |m: &BlockPoint| m.xyz.zip(m.known).map(|pair| (m.control, pair));
    let all: Vec<_> = block.points.iter().filter_map(with_both).collect();
    // Control points decide where there are enough of them: other given coordinates are initial values.
    let control: Vec<_> = all.iter().copied().filter(|(control, _)| *control).collect();
    [control, all].into_iter().any(|pairs| {
        let (source, target): (Vec<_>, Vec<_>) = pairs.into_iter().map(|(_, pair)| pair).unzip();
        let Ok((fit, _)) = fit_robust(&source, &target, 0) else { return false };
        transform(block, &fit.transform);
        true
    })
}

/// Points and photos that must agree before two models are one, and the share of those both have.
const FEWEST_AGREEING: usize = 4;
const AGREEING: f64 = 0.5;

/// The block with a model of other photos joined to it; `None` if their common points do not support it.
///
/// Tried are the similarity over common points and projection centres, and for every photo that both have oriented the
/// one that keeps its pose and takes the scale from the distances of common points. What decides is how many common
/// points of the model appear where the block's photos show them, and the other way round. Where too few points are
/// determined in both, photos of either are oriented relative to each other ([`bridge`]).
pub(super) fn joined(block: &OrientationBlock, model: &OrientationBlock) -> Option<OrientationBlock> {
    let points: Vec<(usize, Vector3<f64>, Vector3<f64>)> =
        (0..block.points.len()).filter_map(|k| Some((k, model.points[k].xyz?, block.points[k].xyz?))).collect();
    let photos: Vec<(Pose, Pose)> =
        model.photos.iter().zip(&block.photos).filter_map(|(m, b)| m.pose.zip(b.pose)).collect();
    let mut tried: Vec<Similarity> = Vec::new();
    let (mut source, mut target): (Vec<_>, Vec<_>) = points.iter().map(|(_, m, b)| (*m, *b)).unzip();
    tried.extend(fit_robust(&source, &target, 0).ok().map(|(fit, _)| fit.transform));
    for (m, b) in &photos {
        source.push(m.centre);
        target.push(b.centre);
    }
    tried.extend(fit_robust(&source, &target, 1).ok().map(|(fit, _)| fit.transform));
    for (m, b) in &photos {
        let others = points.iter().map(|(_, pm, pb)| (pb - b.centre).norm() / (pm - m.centre).norm());
        let centres = photos.iter().map(|(om, ob)| (ob.centre - b.centre).norm() / (om.centre - m.centre).norm());
        let ratios: Vec<f64> = others.chain(centres).filter(|r| r.is_finite() && *r > 0.0).collect();
        if ratios.is_empty() {
            continue;
        }
        let rotation = b.object_to_camera.tr_mul(&m.object_to_camera);
        let scale = quantile(&ratios, 0.5);
        tried.push(Similarity { scale, rotation, source_centroid: m.centre, target_centroid: b.centre });
    }
    let mut best: Option<(usize, usize, OrientationBlock)> = None;
    for similarity in tried {
        let mut moved = model.clone();
        transform(&mut moved, &similarity);
        let (agreeing, compared) = agreement(block, &moved, &points.iter().map(|(k, ..)| *k).collect::<Vec<_>>());
        if best.as_ref().is_none_or(|(most, ..)| agreeing > *most) {
            best = Some((agreeing, compared, moved));
        }
    }
    if let Some((agreeing, compared, moved)) = best
        && agreeing + photos.len() >= FEWEST_AGREEING
        && agreeing as f64 >= AGREEING * compared as f64
    {
        return Some(merged(block.clone(), moved));
    }
    let mut moved = model.clone();
    transform(&mut moved, &bridge::similarity(block, model)?);
    Some(merged(block.clone(), moved))
}

/// Of the common points, those whose place in one model appears where a photo of the other shows it, both ways.
fn agreement(block: &OrientationBlock, moved: &OrientationBlock, common: &[usize]) -> (usize, usize) {
    let appears = |point: &Vector3<f64>, model: &OrientationBlock, k: usize| {
        let observations = model.points[k].observations.iter().filter(|&&s| model.observations[s].taken);
        let misfits = observations.filter_map(|&s| {
            let (pose, ray) = (model.photos[model.observations[s].photo].pose?, model.observations[s].ray?);
            let photo = model.observations[s].photo;
            Some(pose.misfit(point, ray) * model.pixels_per_unit(photo) / model.tolerance_px(photo))
        });
        let lengths: Vec<f64> = misfits.collect();
        !lengths.is_empty() && quantile(&lengths, 0.5) <= WIDE
    };
    let agreeing = common.iter().filter(|&&k| {
        let (Some(own), Some(other)) = (block.points[k].xyz, moved.points[k].xyz) else { return false };
        appears(&other, block, k) && appears(&own, moved, k)
    });
    (agreeing.count(), common.len())
}

/// The block with what it lacks taken from a model in the same system, and with it which measurements agree there. All are compared once
/// more: a few that one model takes and the other contradicts make the next adjustment fail.
pub(super) fn merged(mut block: OrientationBlock, model: OrientationBlock) -> OrientationBlock {
    for (observation, other) in block.observations.iter_mut().zip(&model.observations) {
        if block.photos[observation.photo].pose.is_none() && model.photos[observation.photo].pose.is_some() {
            observation.taken = other.taken;
        }
    }
    for (block_photo, other) in block.photos.iter_mut().zip(model.photos) {
        block_photo.pose = block_photo.pose.or(other.pose);
    }
    for (block_point, other) in block.points.iter_mut().zip(model.points) {
        block_point.xyz = block_point.xyz.or(other.xyz);
    }
    block.review();
    block
}

fn transform(block: &mut OrientationBlock, similarity: &Similarity) {
    for block_photo in &mut block.photos {
        block_photo.pose = block_photo.pose.map(|pose| similarity.pose(&pose));
    }
    for block_point in &mut block.points {
        block_point.xyz = block_point.xyz.map(|xyz| similarity.point(&xyz));
    }
}

/// Gives a model without known points a scale and a place; the second value is whether the scale was measured.
///
/// Scale: the median of length over model length of the distances, or of two known points, else the object's rms extent
/// becomes 1 for want of anything better. Place: that of a photo oriented in `before`, else the principal axes of the
/// object with Z towards the cameras and X to the right of the first of them.
pub(super) fn to_own(
    block: &mut OrientationBlock,
    project: &Project,
    before: &OrientationBlock,
) -> (Option<DatumSource>, bool) {
    let points: Vec<Vector3<f64>> = block.points.iter().filter_map(|m| m.xyz).collect();
    let Ok(spread) = PrincipalAxes::of(&points) else { return (None, false) };
    let measured = scale(block, &project.distances, project);
    let size = spread.extent.norm();
    let factor = measured.unwrap_or(if size > 0.0 { 1.0 / size } else { 1.0 });
    let given = before.photos.iter().zip(&block.photos).find_map(|(b, m)| b.pose.zip(m.pose));
    if let Some((pose, model)) = given {
        let rotation = pose.object_to_camera.tr_mul(&model.object_to_camera);
        let similarity =
            Similarity { scale: factor, rotation, source_centroid: model.centre, target_centroid: pose.centre };
        transform(block, &similarity);
        return (Some(DatumSource::GivenPhotos), measured.is_some());
    }
    let poses: Vec<Pose> = block.photos.iter().filter_map(|v| v.pose).collect();
    let cameras = poses.iter().map(|p| p.centre - spread.centroid).sum::<Vector3<f64>>();
    let mut z = spread.axes.column(2).into_owned();
    if z.dot(&cameras) < 0.0 {
        z = -z;
    }
    let right = poses.first().map_or(Vector3::x(), |p| p.object_to_camera.row(0).transpose());
    let flat = right - z * z.dot(&right);
    let x = if flat.norm() > 1e-3 { flat.normalize() } else { spread.axes.column(0).into_owned() };
    let rotation = Matrix3::from_rows(&[x.transpose(), z.cross(&x).transpose(), z.transpose()]);
    let similarity =
        Similarity { scale: factor, rotation, source_centroid: spread.centroid, target_centroid: Vector3::zeros() };
    transform(block, &similarity);
    (Some(DatumSource::Own), measured.is_some())
}

/// Object length over model length, by the median over the usable distances, else by two known points.
fn scale(block: &OrientationBlock, distances: &[Distance], project: &Project) -> Option<f64> {
    let place = |id: &str| project.points.iter().position(|p| p.id == id);
    let of_distance = |d: &Distance| {
        let (from, to) = (block.points[place(&d.from)?].xyz?, block.points[place(&d.to)?].xyz?);
        Some(d.length / (from - to).norm()).filter(|ratio| ratio.is_finite() && *ratio > 0.0)
    };
    let ratios: Vec<f64> = distances.iter().filter(|d| !d.check).filter_map(of_distance).collect();
    if !ratios.is_empty() {
        return Some(quantile(&ratios, 0.5));
    }
    let known: Vec<_> = block.points.iter().filter_map(|m| m.xyz.zip(m.known)).collect();
    let [(a, known_a), .., (b, known_b)] = known[..] else { return None };
    Some((known_a - known_b).norm() / (a - b).norm()).filter(|ratio| ratio.is_finite() && *ratio > 0.0)
}
