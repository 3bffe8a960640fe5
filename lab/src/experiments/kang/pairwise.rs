//! The counterpart: models formed pair by pair by coplanarity, oriented on the control and averaged.
//!
//! Three photos give three pairs. Each pair is oriented relatively from its fifteen points, intersected, transformed to the
//! three control points by a similarity transform, and the models are averaged. The bundle adjustment of the same
//! draw stands beside it, and the root mean square over several draws of both.
//!
//! With random image errors only, the averaged models' errors grow with the distance, as the bundle's do, and are the
//! larger ones: nothing in the method makes errors fall with distance. A shallow object seen from afar has a second
//! relative orientation that fits about as well; `pair_unaided` takes whichever fits best, as a method does that does
//! not know that the axes are parallel, and where it takes the wrong one the errors jump from network to network. That
//! is irregularity of the paper's kind; whether it was the paper's cause the paper does not let one tell.

use nalgebra::Vector3;

use super::networks::{Case, DISTANCES, network, single};
use crate::experiments::outcome::Tick;
use crate::experiments::{Chart, ExperimentOptions, Series, Table};
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, ResidualPlace, StatisticsChoice};
use sightline::camera::ideal_from_pixel;
use sightline::error::Result;
use sightline::initial::intersection::{Ray, intersect};
use sightline::initial::relative::relative_orientation;
use sightline::initial::{Pose, similarity};
use sightline::project::{Project, Role};
use sightline_plan::network::{Network, simulate};

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
            "pair_unaided_rms|mm|4",
            "pair_unaided_rms_draws|mm|4",
        ],
    );
    let mut lines = [("pair_unaided", Vec::new()), ("pair_draws", Vec::new()), ("bundle_draws", Vec::new())];
    let cases: Vec<Case> = single().into_iter().filter(|c| c.photos.len() == 3).collect();
    for (index, case) in cases.iter().enumerate() {
        report(DISTANCES.iter().position(|d| case.distance == Some(*d)).unwrap_or(0))?;
        let (mut first, mut sums, mut drawn) = (None, [0.0; 3], 0);
        for draw in 0..DRAWS {
            let mut network = network(case, options);
            network.seed = options.seed.wrapping_add(draw);
            let project = simulate(&network)?;
            let Some([pair, unaided]) = pairwise(&network, &project) else { continue };
            let all = [pair, bundle(&network, &project)?, unaided];
            sums.iter_mut().zip(&all).for_each(|(sum, axes)| *sum += total(axes).powi(2));
            drawn += 1;
            first.get_or_insert(all);
        }
        let Some([pair, bundle, unaided]) = first else { continue };
        let mean = sums.map(|s| (s / f64::from(drawn)).sqrt());
        let mut row = vec![case.name().as_str().into()];
        row.extend(pair.map(Into::into));
        row.push(total(&pair).into());
        row.extend(bundle.map(Into::into));
        row.extend([total(&bundle), mean[0], mean[1], total(&unaided), mean[2]].map(Into::into));
        table.rows.push(row);
        // A place is left free between two distances.
        let at = (index + index / 3) as f64;
        let values = [total(&unaided), mean[0], mean[1]];
        lines.iter_mut().zip(values).for_each(|((_, line), value)| line.push([at, value]));
    }
    let pieces = |(id, line): (&str, Vec<[f64; 2]>)| -> Vec<Series> {
        line.chunks(3).map(|piece| Series::new(id, piece.to_vec())).collect()
    };
    let series = lines.into_iter().flat_map(pieces).collect();
    let mut chart = Chart::new("pairwise", "type", "rms_error|mm", series);
    for (i, distance) in DISTANCES.into_iter().enumerate() {
        let tick = |k: usize, text: &str, group| Tick { at: (4 * i + k) as f64, text: text.into(), group };
        chart.x.ticks.extend(["A", "B", "C"].iter().enumerate().map(|(k, kind)| tick(k, kind, false)));
        chart.x.ticks.push(tick(1, &format!("{distance:.1} m"), true));
    }
    Ok(Comparison { table, chart })
}

fn total(axes: &[f64; 3]) -> f64 {
    (axes.iter().map(|a| a * a).sum::<f64>() / 3.0).sqrt()
}

/// Rms errors per axis of the averaged models, pairs oriented with and without knowing that the axes are parallel; none
/// when a pair cannot be oriented.
fn pairwise(network: &Network, project: &Project) -> Option<[[f64; 3]; 2]> {
    let images: Vec<Vec<[f64; 2]>> =
        project.photos.iter().map(|photo| ideal(project, &photo.id)).collect::<Option<_>>()?;
    let control: Vec<usize> = (0..project.points.len()).filter(|k| project.points[*k].role == Role::Control).collect();
    let given: Option<Vec<_>> = control.iter().map(|k| project.points[*k].xyz.map(Vector3::from)).collect();
    let given = given?;
    let mut sums = [(); 2].map(|()| vec![Vector3::zeros(); project.points.len()]);
    let mut models = 0.0;
    for i in 0..images.len() {
        for j in i + 1..images.len() {
            for (sums, model) in sums.iter_mut().zip(models_of(&images[i], &images[j])?) {
                let source: Vec<_> = control.iter().map(|k| model[*k]).collect();
                let onto = similarity::fit(&source, &given).ok()?.transform;
                sums.iter_mut().zip(&model).for_each(|(sum, point)| *sum += onto.point(point));
            }
            models += 1.0;
        }
    }
    Some(sums.map(|sums| errors(network, |k| Some(sums[k] / models))))
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

/// Object points in the order of the project's.
type Model = Vec<Vector3<f64>>;

/// The models of a pair, intersected in the frame of its first photo with a base of 1: with the orientation nearest to
/// parallel axes, which are known to be, and with the one that fits best.
fn models_of(first: &[[f64; 2]], second: &[[f64; 2]]) -> Option<[Model; 2]> {
    // 3 µm on 100 mm is 3e-5; ten times that is no gross error.
    let oriented = relative_orientation(first, second, 3e-4, 1).ok()?;
    let turn = |pose: &Pose| pose.object_to_camera.trace();
    let parallel = oriented.iter().map(|o| o.pose).max_by(|a, b| turn(a).total_cmp(&turn(b)))?;
    let intersected = |pose: Pose| -> Option<Model> {
        let point = |(a, b): (&[f64; 2], &[f64; 2])| {
            let rays = [Ray { pose: Pose::identity(), image: *a, weight: 1.0 }, Ray { pose, image: *b, weight: 1.0 }];
            intersect(&rays).ok().map(|found| found.point)
        };
        first.iter().zip(second).map(point).collect()
    };
    Some([intersected(parallel)?, intersected(oriented[0].pose)?])
}

fn bundle(network: &Network, project: &Project) -> Result<[f64; 3]> {
    let choice = AdjustOptions {
        statistics: StatisticsChoice::None,
        residuals: ResidualPlace::Corrected,
        ..AdjustOptions::default()
    };
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
