//! What the 3-D view is given: the points, photos, lines and features of a result about the middle of the object.

use std::collections::{BTreeSet, HashMap, HashSet};

use sightline::adjustment::{LeftOutKind, MeasuredFeature, Quantity};
use sightline::depiction::{drawn, ellipsoid, exaggeration, extent, frustum, round};
use sightline::project::{Project, Role};

use crate::browser::object::{Label, Scene, numbered};
use crate::format;
use crate::i18n::text;
use crate::store::document::Outcome;
use crate::view::results::units::unit_of;

/// The scene of a result; `chosen` is the feature whose deviations are drawn.
pub fn scene(result: &Outcome, project: &Project, chosen: Option<&str>) -> Scene {
    let adjustment = &result.adjustment;
    let (centre, size) = extent(adjustment.points.iter().map(|p| p.xyz));
    let about = |xyz: [f64; 3]| -> [f32; 3] { std::array::from_fn(|k| (xyz[k] - centre[k]) as f32) };
    let mut scene = Scene {
        key: format!("{} {size:e}", project.name),
        unit: unit_of(&result.adjustment, project),
        size,
        ..Scene::default()
    };
    scene.grid = round(size / 8.0);
    let roles: HashMap<&str, Role> = project.points.iter().map(|p| (p.id.as_str(), p.role)).collect();
    let not_used: HashSet<&str> = adjustment.left_out.iter().filter_map(|item| item.point.as_deref()).collect();
    let known = adjustment.points.iter().all(|p| p.covariance.is_some());
    for point in &adjustment.points {
        scene.names.push(point.id.clone());
        scene.points.extend(about(point.xyz));
        let role = match roles.get(point.id.as_str()).copied().unwrap_or_default() {
            Role::Tie => 0,
            Role::Control => 1,
            Role::Check => 2,
        };
        // Two rays see no gross error along the epipolar line; of the others something was not used.
        let doubtful = point.rays < 3 || not_used.contains(point.id.as_str());
        scene.roles.push(role | if doubtful { 4 } else { 0 });
        if let Some(covariance) = point.covariance.filter(|_| known) {
            scene.ellipsoids.extend(ellipsoid(covariance).iter().map(|x| *x as f32));
        }
    }
    let names = std::mem::take(&mut scene.names);
    let number = numbered(&names);
    let corners = scene.points.chunks_exact(3);
    let (low, high) = corners.fold(([0.0_f32; 3], [0.0_f32; 3]), |(low, high), p| {
        (std::array::from_fn(|k| low[k].min(p[k])), std::array::from_fn(|k| high[k].max(p[k])))
    });
    scene.bounds = [low[0], low[1], low[2], high[0], high[1], high[2]];
    let mut photo_number = HashMap::new();
    for photo in &adjustment.photos {
        let Some(own) = project.photos.iter().find(|p| p.id == photo.id) else { continue };
        let Some(camera) = project.cameras.iter().find(|c| c.id == own.camera) else { continue };
        let Some(frustum) = frustum(camera, photo.position, photo.rotation, 0.14 * size) else { continue };
        photo_number.insert(photo.id.as_str(), scene.photo_names.len() as u32);
        scene.photo_names.push(photo.id.clone());
        scene.photos.extend(frustum.into_iter().flat_map(about));
    }
    let mut rays: Vec<Vec<u32>> = vec![Vec::new(); names.len()];
    for o in adjustment.observations.iter().filter(|o| o.enabled) {
        if let (Some(k), Some(photo)) = (number.get(o.point.as_str()), photo_number.get(o.photo.as_str())) {
            rays[*k].push(*photo);
        }
    }
    scene.ray_start.push(0);
    for of_point in rays {
        scene.ray_photos.extend(of_point);
        scene.ray_start.push(scene.ray_photos.len() as u32);
    }
    let at = |id: &str| number.get(id).map(|k| about(adjustment.points[*k].xyz));
    for item in adjustment.left_out.iter().filter(|item| item.kind == LeftOutKind::Control && item.given.is_none()) {
        let point = item.point.as_deref().and_then(|id| project.points.iter().find(|p| p.id == id));
        if let Some((id, given)) = point.and_then(|p| Some((&p.id, p.xyz?))) {
            // Where the photos see it, or else where it was given.
            let words = format!("{id}: {}", text::not_used_cell());
            let place = at(id).unwrap_or_else(|| about(given));
            scene.labels.push(Label { words, place, chosen: false, warning: true });
        }
    }
    let colours: HashMap<&str, [u8; 3]> = project.layers.iter().map(|l| (l.id.as_str(), l.colour)).collect();
    for line in &project.lines {
        if let (Some(from), Some(to)) = (at(&line.from), at(&line.to)) {
            scene.lines.extend(from.into_iter().chain(to));
            scene.line_colours.extend(colours.get(line.layer.as_str()).copied().unwrap_or_default());
        }
    }
    for distance in &project.distances {
        if let (Some(from), Some(to)) = (at(&distance.from), at(&distance.to)) {
            scene.distances.extend(from.into_iter().chain(to));
            let words = format!(
                "{} – {}  {}",
                distance.from,
                distance.to,
                format::fixed(distance.length, format::decimals_for(distance.sigma))
            );
            scene.labels.push(Label {
                words,
                place: std::array::from_fn(|k| 0.5 * (from[k] + to[k])),
                chosen: false,
                warning: false,
            });
        }
    }
    let mut differences = |id: &str, difference: [f64; 3]| {
        if let Some(place) = at(id) {
            scene.residuals.extend(place.into_iter().chain(difference.map(|d| d as f32)));
        }
    };
    for check in &adjustment.check_points {
        check.difference.into_iter().for_each(|d| differences(&check.id, d));
    }
    for point in project.points.iter().filter(|p| p.role == Role::Control) {
        if let (Some(given), Some(k)) = (point.xyz, number.get(point.id.as_str())) {
            let found = adjustment.points[*k].xyz;
            let difference: [f64; 3] = std::array::from_fn(|a| found[a] - given[a]);
            if difference.iter().any(|d| *d != 0.0) {
                differences(&point.id, difference);
            }
        }
    }
    for feature in adjustment.features.iter().filter(|f| f.error.is_none()) {
        let own = feature.residuals.iter().filter_map(|r| number.get(r.point.as_str()));
        let own: Vec<[f64; 3]> = own.map(|k| adjustment.points[*k].xyz).collect();
        feature_drawn(&mut scene, feature, &own, &about, chosen == Some(feature.id.as_str()));
    }
    if let Some(feature) = chosen.and_then(|id| adjustment.features.iter().find(|f| f.id == id)) {
        sticks(&mut scene, feature, adjustment.features.as_slice(), project, &about, &at);
    }
    scene.names = names;
    scene
}

/// Exaggerations that suit a result: of its ellipsoids, and of the vectors in its scene.
pub fn factors(result: &Outcome, scene: &Scene) -> (f64, f64) {
    let sigmas = result.adjustment.points.iter().filter_map(|p| p.sigma).map(|[x, y, z]| x.max(y).max(z));
    let length = |v: &[f32]| v[3..6].iter().map(|x| f64::from(*x).powi(2)).sum::<f64>().sqrt();
    let vectors = scene.residuals.chunks_exact(6).chain(scene.sticks.chunks_exact(6)).map(length);
    (exaggeration(sigmas, scene.size), 3.0 * exaggeration(vectors, scene.size))
}

type About<'a> = &'a dyn Fn([f64; 3]) -> [f32; 3];
type At<'a> = &'a dyn Fn(&str) -> Option<[f32; 3]>;

fn add(a: [f64; 3], s: f64, b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] + s * b[k])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = dot(a, a).sqrt();
    if length > 0.0 { a.map(|x| x / length) } else { a }
}

/// A feature's outline, its surface and its name.
fn feature_drawn(scene: &mut Scene, feature: &MeasuredFeature, points: &[[f64; 3]], about: About, chosen: bool) {
    let drawn = drawn(feature, points);
    scene.forms.extend(drawn.outline.into_iter().flatten().flat_map(about));
    let surface = if chosen { &mut scene.chosen_surface } else { &mut scene.surfaces };
    surface.extend(drawn.surface.into_iter().flatten().flat_map(about));
    let Some(place) = drawn.label else { return };
    // What a length or an angle is stands with it; of the others the panel has it.
    let shown = feature.value.filter(|_| matches!(feature.kind.as_str(), "distance" | "angle")).map(|value| {
        let angle = feature.quantity == Some(Quantity::Angle);
        let shown = |x: f64| if angle { x.to_degrees() } else { x };
        let decimals = feature.sigma.map(shown).filter(|s| *s > 0.0).map_or(3, format::decimals_for);
        format!("  {}{}", format::fixed(shown(value), decimals), if angle { "°" } else { "" })
    });
    let words = format!("{}{}", feature.id, shown.unwrap_or_default());
    scene.labels.push(Label { words, place: about(place), chosen, warning: false });
}

/// Deviations of a feature's points as vectors across the form.
fn sticks(
    scene: &mut Scene,
    feature: &MeasuredFeature,
    all: &[MeasuredFeature],
    project: &Project,
    about: About,
    at: At,
) {
    let on = project.features.iter().find(|f| f.id == feature.id).and_then(|f| match &f.kind {
        sightline::project::FeatureKind::Deviations { feature, .. } => feature.clone(),
        _ => Some(f.id.clone()),
    });
    let form = on.and_then(|id| all.iter().find(|f| f.id == id));
    let mut seen = BTreeSet::new();
    for residual in feature.residuals.iter().filter(|r| seen.insert(r.point.as_str())) {
        let Some(place) = at(&residual.point) else { continue };
        let vector = residual.difference.or_else(|| {
            let form = form?;
            let v = add(place.map(f64::from), -1.0, about(form.position?).map(f64::from));
            let direction = form.direction.unwrap_or_default();
            let outwards = match form.kind.as_str() {
                "plane" => direction,
                "sphere" => unit(v),
                _ => unit(add(v, -dot(v, direction), direction)),
            };
            Some(outwards.map(|x| x * residual.value))
        });
        if let Some(vector) = vector {
            scene.sticks.extend(place.into_iter().chain(vector.map(|x| x as f32)));
            scene.stick_signs.push(if residual.value < 0.0 { -1 } else { 1 });
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use sightline::adjustment::{AdjustedObservation, AdjustedPhoto, AdjustedPoint, Adjustment};
    use sightline::project::{Camera, Interior, Photo, Point};

    use super::*;

    #[test]
    fn the_scene_has_every_point_photo_and_ray_about_the_middle() {
        let point = |id: &str, x: f64| AdjustedPoint {
            id: id.into(),
            xyz: [1e6 + x, 5.0, 0.0],
            covariance: Some([1e-4, 0.0, 0.0, 1e-4, 0.0, 1e-4]),
            sigma: Some([0.01; 3]),
            rays: 2,
        };
        let ray = |point: &str| AdjustedObservation {
            photo: "p".into(),
            point: point.into(),
            enabled: true,
            ..AdjustedObservation::default()
        };
        let adjustment = Adjustment {
            points: vec![point("1", 0.0), point("2", 100.0)],
            photos: vec![AdjustedPhoto { id: "p".into(), position: [1e6, 0.0, 50.0], ..AdjustedPhoto::default() }],
            observations: vec![ray("2")],
            ..Adjustment::default()
        };
        let project = Project {
            cameras: vec![Camera::new("c", 40, 30, Interior::brown(50.0))],
            photos: vec![Photo { id: "p".into(), camera: "c".into(), enabled: true, ..Photo::default() }].into(),
            points: vec![
                Point { id: "1".into(), role: Role::Control, xyz: Some([1e6, 5.0, 0.5]), ..Point::default() },
                Point { id: "2".into(), ..Point::default() },
            ]
            .into(),
            ..Project::default()
        };
        let input = Arc::new(project.clone());
        let result = Outcome { input: input.clone(), oriented: input, adjustment };
        let scene = scene(&result, &project, None);
        assert_eq!(scene.points, [-50.0, 0.0, 0.0, 50.0, 0.0, 0.0]);
        assert_eq!(scene.roles, [5, 4]);
        assert_eq!((scene.ray_start, scene.ray_photos), (vec![0, 0, 1], vec![0]));
        assert_eq!((scene.photos.len(), scene.ellipsoids.len(), scene.residuals.len()), (15, 18, 6));
        assert_eq!(&scene.residuals[3..], [0.0, 0.0, -0.5]);
        assert_eq!(scene.grid, 10.0);
    }
}
