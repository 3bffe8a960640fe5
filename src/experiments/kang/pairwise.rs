//! The counterpart: models formed pair by pair by coplanarity, oriented on the control and averaged.
//!
//! Three photos give three pairs. Each pair is oriented relatively from its fifteen points, intersected, carried onto the
//! three control points by a similarity transform, and the models are averaged. The bundle adjustment of the same
//! draw stands beside it. The errors of one draw are irregular, since three control points of one draw carry each
//! model; the root mean square over several draws shows what is behind the irregularity.

use nalgebra::Vector3;

use super::networks::{Case, DISTANCES, network, single};
use crate::adjust::adjust;
use crate::adjustment::{AdjustOptions, StatisticsChoice};
use crate::camera::ideal_from_pixel;
use crate::error::Result;
use crate::experiments::{Chart, ExperimentOptions, Series, Table};
use crate::initial::intersection::{Ray, intersect};
use crate::initial::relative::relative_orientation;
use crate::initial::{Pose, similarity};
use crate::network::{Network, simulate};
use crate::project::{Project, Role};

/// Draws behind the root mean squares.
const DRAWS: u64 = 4;

/// The comparison as data.
pub struct Comparison {
    pub table: Table,
    pub chart: Chart,
}

/// Compares both ways over the distances and base lines with three photos.
pub fn compare(options: &ExperimentOptions, report: &mut dyn FnMut(usize) -> Result<()>) -> Result<Comparison> {
    let mut table = Table::new(
        "pairwise",
        &[
            "network",
            "pair_x|mm|4",
            "pair_y|mm|4",
            "pair_z|mm|4",
            "pair_rms|mm|4",
            "bundle_x|mm|4",
            "bundle_y|mm|4",
            "bundle_z|mm|4",
            "bundle_rms|mm|4",
            "pair_rms_draws|mm|4",
            "bundle_rms_draws|mm|4",
        ],
    );
    let mut lines =
        [("pair", Vec::new()), ("bundle", Vec::new()), ("pair_draws", Vec::new()), ("bundle_draws", Vec::new())];
    let cases: Vec<Case> = single().into_iter().filter(|c| c.photos.len() == 3).collect();
    for (index, case) in cases.iter().enumerate() {
        report(DISTANCES.iter().position(|d| case.distance == Some(*d)).unwrap_or(0))?;
        let (mut first, mut sums, mut drawn) = (None, [0.0; 2], 0);
        for draw in 0..DRAWS {
            let mut network = network(case, options);
            network.seed = options.seed.wrapping_add(draw);
            let project = simulate(&network)?;
            let Some(pair) = pairwise(&network, &project) else { continue };
            let bundle = bundle(&network, &project)?;
            sums[0] += total(&pair).powi(2);
            sums[1] += total(&bundle).powi(2);
            drawn += 1;
            first.get_or_insert((pair, bundle));
        }
        let Some((pair, bundle)) = first else { continue };
        let mean = sums.map(|s| (s / f64::from(drawn)).sqrt());
        let mut row = vec![case.name().as_str().into()];
        row.extend(pair.map(Into::into));
        row.push(total(&pair).into());
        row.extend(bundle.map(Into::into));
        row.extend([total(&bundle), mean[0], mean[1]].map(Into::into));
        table.rows.push(row);
        let values = [total(&pair), total(&bundle), mean[0], mean[1]];
        lines.iter_mut().zip(values).for_each(|((_, line), value)| line.push([index as f64, value]));
    }
    let series = lines.into_iter().map(|(id, points)| Series::new(id, points)).collect();
    Ok(Comparison { table, chart: Chart::new("pairwise", "network", "rms_error|mm", series) })
}

fn total(axes: &[f64; 3]) -> f64 {
    (axes.iter().map(|a| a * a).sum::<f64>() / 3.0).sqrt()
}

/// Rms errors per axis of the averaged models; none when a pair cannot be oriented.
fn pairwise(network: &Network, project: &Project) -> Option<[f64; 3]> {
    let images: Vec<Vec<[f64; 2]>> =
        project.photos.iter().map(|photo| ideal(project, &photo.id)).collect::<Option<_>>()?;
    let control: Vec<usize> = (0..project.points.len()).filter(|k| project.points[*k].role == Role::Control).collect();
    let given: Option<Vec<_>> = control.iter().map(|k| project.points[*k].xyz.map(Vector3::from)).collect();
    let given = given?;
    let mut sums = vec![Vector3::zeros(); project.points.len()];
    let mut models = 0.0;
    for i in 0..images.len() {
        for j in i + 1..images.len() {
            let model = model(&images[i], &images[j])?;
            let source: Vec<_> = control.iter().map(|k| model[*k]).collect();
            let onto = similarity::fit(&source, &given).ok()?.transform;
            sums.iter_mut().zip(&model).for_each(|(sum, point)| *sum += onto.point(point));
            models += 1.0;
        }
    }
    let found: Vec<_> = sums.iter().map(|sum| sum / models).collect();
    Some(errors(network, |k| Some(found[k])))
}

/// Ideal coordinates of every point in a photo, in the order of the points; all points are in all photos here.
fn ideal(project: &Project, photo: &str) -> Option<Vec<[f64; 2]>> {
    let camera_id = &project.photos.iter().find(|p| p.id == photo)?.camera;
    let camera = project.cameras.iter().find(|c| c.id == *camera_id)?;
    let one = |id: &String| {
        let o = project.observations.iter().find(|o| o.photo == photo && o.point == *id)?;
        ideal_from_pixel(camera, [o.u, o.v])
    };
    project.points.iter().map(|p| one(&p.id)).collect()
}

/// The model of a pair: intersected in the frame of its first photo with a base of 1.
fn model(first: &[[f64; 2]], second: &[[f64; 2]]) -> Option<Vec<Vector3<f64>>> {
    // 3 µm on 100 mm is 3e-5; ten times that is no gross error.
    let oriented = relative_orientation(first, second, 3e-4, 1).ok()?;
    // A shallow object has two orientations that fit alike; the axes are known to be parallel.
    let turn = |pose: &Pose| pose.object_to_camera.trace();
    let pose = oriented.iter().map(|o| o.pose).max_by(|a, b| turn(a).total_cmp(&turn(b)))?;
    let point = |(a, b): (&[f64; 2], &[f64; 2])| {
        let rays = [Ray { pose: Pose::identity(), image: *a, weight: 1.0 }, Ray { pose, image: *b, weight: 1.0 }];
        intersect(&rays).ok().map(|found| found.point)
    };
    first.iter().zip(second).map(point).collect()
}

fn bundle(network: &Network, project: &Project) -> Result<[f64; 3]> {
    let choice = AdjustOptions { statistics: StatisticsChoice::None, ..AdjustOptions::default() };
    let adjustment = adjust(project, &choice, &mut |_| true)?;
    let found = |k: usize| adjustment.points.iter().find(|p| p.id == network.points[k].id).map(|p| p.xyz.into());
    Ok(errors(network, found))
}

/// Rms differences from the truth per axis over the points that are not control.
fn errors(network: &Network, found: impl Fn(usize) -> Option<Vector3<f64>>) -> [f64; 3] {
    let ties = network.points.iter().enumerate().filter(|(_, p)| p.role == Role::Tie);
    let differences: Vec<_> = ties.filter_map(|(k, p)| Some(found(k)? - Vector3::from(p.xyz))).collect();
    [0, 1, 2].map(|k| (differences.iter().map(|d| d[k] * d[k]).sum::<f64>() / differences.len().max(1) as f64).sqrt())
}
