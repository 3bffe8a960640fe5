//! The network: number of rays per point, and weaknesses.

use std::collections::BTreeMap;

use crate::context::{Context, listed};
use crate::html::{Html, Table};
use crate::names::parameter_name;
use crate::number::{compact, count, factor, fixed};
use sightline::adjustment::{Advice, CameraDoubt, Exchange, ImplausibleCamera, OneStation, UnitOf, UnitRatio};

use super::patterns;

pub fn write(context: &Context, html: &mut Html) {
    let (words, a) = (context.words, context.adjustment);
    let rays: usize = a.points.iter().map(|p| p.rays).sum();
    let mean = rays as f64 / a.points.len().max(1) as f64;
    let fewest = a.points.iter().map(|p| p.rays).min().unwrap_or(0);
    html.p(&words.network_line(&count(a.photos.len()), &count(a.points.len()), &fixed(mean, 1), &count(fewest)));
    html.open("div", "two");
    html.open("div", "").h3(words.points_by_rays()).table(by_rays(context)).close("div");
    html.open("div", "").h3(words.weakest_points()).table(weakest(context)).close("div");
    html.close("div");
    let weak: Vec<String> = a.advice.iter().map(|advice| sentence(context, advice)).collect();
    if weak.is_empty() {
        html.note(words.no_weakness());
    } else {
        html.h3(words.weaknesses()).list(&weak);
    }
}

fn by_rays(context: &Context) -> Table {
    let words = context.words;
    let mut counts = BTreeMap::new();
    for point in &context.adjustment.points {
        *counts.entry(point.rays).or_insert(0_usize) += 1;
    }
    let mut table = Table::new().number(words.rays()).number(words.points()).number("%");
    let all = context.adjustment.points.len().max(1) as f64;
    for (rays, n) in counts {
        table.row(vec![count(rays), count(n), fixed(100.0 * n as f64 / all, 1)]);
    }
    table
}

fn weakest(context: &Context) -> Table {
    let (words, unit) = (context.words, context.unit);
    let mut table = Table::new().words(words.point()).number(words.rays());
    for axis in context.axes.names() {
        table = table.low("σ", axis, unit);
    }
    let largest = |sigma: &[f64; 3]| sigma.iter().copied().fold(0.0, f64::max);
    let mut points: Vec<_> = context.adjustment.points.iter().filter_map(|p| Some((p, p.sigma?))).collect();
    points.sort_by(|a, b| largest(&b.1).total_cmp(&largest(&a.1)));
    for (point, sigma) in points.into_iter().take(8) {
        let mut row = vec![point.id.clone(), count(point.rays)];
        row.extend(context.axes.shown(sigma).map(|s| context.length(s)));
        table.row(row);
    }
    table
}

/// The axis along which a difference is largest.
fn main_axis(context: &Context, difference: &[f64; 3]) -> &'static str {
    let largest = (0..3).max_by(|&a, &b| difference[a].abs().total_cmp(&difference[b].abs()));
    context.axes.letter(largest.unwrap_or_default())
}

/// A weakness in a sentence.
pub fn sentence(context: &Context, advice: &Advice) -> String {
    let words = context.words;
    let name = |name: &str| name.parse().map_or(name.to_owned(), |p| parameter_name(p).to_owned());
    let pairs = |all: &[(String, String)]| {
        let names: Vec<String> = all.iter().map(|(a, b)| format!("{a} – {b}")).collect();
        listed(names.iter().map(String::as_str), 5)
    };
    match advice {
        Advice::HighCorrelation { camera, photo, first, second, correlation } => {
            let place = photo.as_ref().map_or(camera.clone(), |photo| format!("{camera} · {photo}"));
            words.weak_correlation(&place, &name(first), &name(second), &fixed(*correlation, 2))
        }
        Advice::LowRedundancy { observations, given } => {
            words.weak_redundancy(&count(observations.len() + given.len()))
        }
        Advice::TwoRays { points } => {
            words.weak_two_rays(&count(points.len()), &listed(points.iter().map(String::as_str), 5))
        }
        Advice::NarrowIntersection { points } => {
            words.weak_narrow(&count(points.len()), &listed(points.iter().map(|(id, _)| id.as_str()), 5))
        }
        Advice::BehindCamera { observations } => words.weak_behind(&pairs(observations)),
        Advice::DistanceUnused { distances } => words.weak_distance_unused(&pairs(distances)),
        Advice::WeakPrincipalDistance { camera, value, sigma, .. } => {
            words.weak_principal_distance(camera, &fixed(*value, 2), &fixed(*sigma, 2))
        }
        Advice::GrossErrorsUnsettled => words.weak_unsettled().to_owned(),
        Advice::VarianceComponentsUnsettled => words.weak_components().to_owned(),
        Advice::ResidualPattern { camera, pattern, photos, max_px, remedy, .. } => {
            patterns::sentence(context, camera, (*pattern, photos), *max_px, remedy)
        }
        Advice::SigmasTooSmall { sigma0, .. } => words.weak_sigmas(&fixed(*sigma0, 3)),
        Advice::UnmodelledAgain { sigma0, .. } => words.weak_unmodelled(&fixed(*sigma0, 3)),
        Advice::Insignificant { camera, parameter, ratio, .. } => {
            words.weak_insignificant(camera, &parameter_name(*parameter), &fixed(*ratio, 1))
        }
        Advice::Suspected { count: n, observations, given } => {
            let given = given.iter().map(|(what, _)| context.given_name(what));
            let names: Vec<String> =
                given.chain(observations.iter().map(|(photo, point, _)| format!("{point} – {photo}"))).collect();
            words.weak_suspected(&count(*n), &listed(names.iter().map(String::as_str), 5))
        }
        Advice::ControlMisfit { point, difference, sigma_ratio } => {
            let axis = &main_axis(context, difference);
            let size = context.with_unit(difference[0].hypot(difference[1]).hypot(difference[2]));
            words.control_misfit(point, &size, &fixed(*sigma_ratio, 0), axis)
        }
        Advice::ExchangedPoints { points: [a, b] } => words.exchanged_points(a, b),
        Advice::DoublePoints { pairs: all } => words.double_points(&count(all.len()), &pairs(all)),
        Advice::MirroredControl(mirrored) => {
            let [given, exchanged] =
                [mirrored.rms_given, mirrored.rms_exchanged].map(|rms| context.in_unit(&compact(rms)));
            words.weak_mirrored(&exchange(context, mirrored.exchange), &exchanged, &given)
        }
        Advice::UndecidedAxes(undecided) => words.weak_undecided(&count(undecided.points)),
        Advice::UnitRatio(unit) => unit_ratio(context, unit),
        Advice::OneStation(OneStation { photos, all: true }) => words.weak_one_station_all(&count(photos.len())),
        Advice::OneStation(OneStation { photos, .. }) => {
            words.weak_one_station(&listed(photos.iter().map(String::as_str), 8))
        }
        Advice::ImplausibleCamera(ImplausibleCamera { camera, doubt }) => implausible(context, camera, doubt),
        Advice::NoScale => words.scale_none().to_owned(),
    }
}

/// Contradictions between the photos and given values, which tests of residuals may not show; also listed in the summary.
pub fn questions(context: &Context) -> Vec<String> {
    context.adjustment.advice.iter().filter(|a| a.contradicts()).map(|advice| sentence(context, advice)).collect()
}

fn exchange(context: &Context, exchange: Exchange) -> String {
    let words = context.words;
    let [x, y, z] = [0, 1, 2].map(|axis| context.axes.letter(axis));
    match exchange {
        Exchange::Xy => words.exchanging(&x, &y),
        Exchange::Xz => words.exchanging(&x, &z),
        Exchange::Yz => words.exchanging(&y, &z),
        Exchange::X => words.negating(&x),
        Exchange::Y => words.negating(&y),
        Exchange::Z => words.negating(&z),
    }
}

fn unit_ratio(context: &Context, unit: &UnitRatio) -> String {
    let words = context.words;
    let pairs: Vec<String> = unit.distances.iter().map(|(a, b)| format!("{a} – {b}")).collect();
    let bars = listed(pairs.iter().map(String::as_str), 5);
    let (ratio, nearest) = (factor(unit.ratio), factor(unit.nearest));
    match (unit.of, &unit.camera) {
        (UnitOf::Distance, _) if !pairs.is_empty() => words.weak_unit_distance(&bars, &ratio, &nearest),
        (UnitOf::Control, _) if !pairs.is_empty() => words.weak_unit_control(&ratio, &nearest),
        (UnitOf::Camera, Some(camera)) => words.weak_unit_camera(camera, &ratio, &nearest),
        _ => words.weak_unit_diameter(&nearest),
    }
}

fn implausible(context: &Context, camera: &str, doubt: &CameraDoubt) -> String {
    let words = context.words;
    match doubt {
        CameraDoubt::FieldOfView { angle, value, pixels } => {
            let (value, angle) = (compact(*value), fixed(angle.to_degrees(), 1));
            if *pixels {
                words.weak_view_pixels(&camera, &value, &angle)
            } else {
                words.weak_view(&camera, &value, &angle)
            }
        }
        CameraDoubt::ImageSize { photos, size: [width, height], measured: [u, v] } => words.weak_image_size(
            &camera,
            &format!("{width} × {height}"),
            &listed(photos.iter().map(String::as_str), 5),
            &format!("{} × {}", fixed(*u, 0), fixed(*v, 0)),
        ),
        CameraDoubt::Resized { photo, factor } => words.weak_resized(photo, &camera, &compact(*factor)),
        CameraDoubt::Cropped { photo, offset: [u, v] } => {
            words.weak_cropped(photo, &camera, &format!("{}, {}", fixed(*u, 0), fixed(*v, 0)))
        }
        CameraDoubt::OtherDistance { photo, value } => words.weak_other_distance(photo, &camera, &compact(*value)),
    }
}
