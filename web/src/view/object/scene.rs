//! What the 3-D view is given: the points, photos, lines and features of a result about the middle of the object.

use std::collections::{BTreeSet, HashMap, HashSet};

use sightline::adjustment::{Adjustment, LeftOutKind, MeasuredFeature, Quantity};
use sightline::depiction::{drawn, ellipsoid, exaggeration, extent, frustum, round};
use sightline::project::{Project, Role};

use crate::browser::object::{Scene, SceneLabel};
use crate::document::AdjustmentResult;
use crate::format;
use crate::i18n::text;
use crate::view::components::units::unit_of;

/// The scene of a result; `chosen` is the feature whose deviations are drawn.
pub fn scene(result: &AdjustmentResult, project: &Project, chosen: Option<&str>) -> Scene {
    let adjustment = &result.adjustment;
    let (centre, size) = extent(adjustment.points.iter().map(|p| p.xyz));
    let mut scene = Scene {
        key: format!("{} {size:e}", project.name),
        unit: unit_of(&result.adjustment, project),
        size,
        grid: round(size / 8.0),
        names: adjustment.points.iter().map(|p| p.id.clone()).collect(),
        ..Scene::default()
    };
    let number = adjustment.points.iter().enumerate().map(|(k, point)| (point.id.as_str(), k)).collect();
    let source = SceneSource { adjustment, project, centre, number };
    source.add_points(&mut scene);
    source.add_photos(&mut scene);
    source.add_unused_control(&mut scene);
    source.add_lines(&mut scene);
    source.add_distances(&mut scene);
    source.add_differences(&mut scene);
    source.add_features(&mut scene, chosen);
    scene
}

/// Parameters of a scene.
struct SceneSource<'a> {
    adjustment: &'a Adjustment,
    project: &'a Project,
    /// The middle of the object, which the scene's coordinates count from.
    centre: [f64; 3],
    /// Places of the adjusted points by their identifiers.
    number: HashMap<&'a str, usize>,
}

impl SceneSource<'_> {
    /// A place about the middle of the object.
    fn about(&self, xyz: [f64; 3]) -> [f32; 3] {
        std::array::from_fn(|k| (xyz[k] - self.centre[k]) as f32)
    }

    /// Place of an adjusted point.
    fn at(&self, id: &str) -> Option<[f32; 3]> {
        self.number.get(id).map(|k| self.about(self.adjustment.points[*k].xyz))
    }

    fn add_points(&self, scene: &mut Scene) {
        let Self { adjustment, project, .. } = self;
        let roles: HashMap<&str, Role> = project.points.iter().map(|p| (p.id.as_str(), p.role)).collect();
        let not_used: HashSet<&str> = adjustment.left_out.iter().filter_map(|item| item.point.as_deref()).collect();
        let known = adjustment.points.iter().all(|p| p.covariance.is_some());
        for point in &adjustment.points {
            scene.points.extend(self.about(point.xyz));
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
        let corners = scene.points.chunks_exact(3);
        let (low, high) = corners.fold(([0.0_f32; 3], [0.0_f32; 3]), |(low, high), p| {
            (std::array::from_fn(|k| low[k].min(p[k])), std::array::from_fn(|k| high[k].max(p[k])))
        });
        scene.bounds = [low[0], low[1], low[2], high[0], high[1], high[2]];
    }

    /// Photos, and the rays from them to the points.
    fn add_photos(&self, scene: &mut Scene) {
        let Self { adjustment, project, .. } = self;
        let mut photo_number = HashMap::new();
        for photo in &adjustment.photos {
            let Some(own) = project.photos.iter().find(|p| p.id == photo.id) else { continue };
            let Some(camera) = project.cameras.iter().find(|c| c.id == own.camera) else { continue };
            let Some(frustum) = frustum(camera, photo.position, photo.rotation, 0.14 * scene.size) else { continue };
            photo_number.insert(photo.id.as_str(), scene.photo_names.len() as u32);
            scene.photo_names.push(photo.id.clone());
            scene.photos.extend(frustum.into_iter().flat_map(|xyz| self.about(xyz)));
        }
        let mut rays: Vec<Vec<u32>> = vec![Vec::new(); adjustment.points.len()];
        for o in adjustment.observations.iter().filter(|o| o.enabled) {
            if let (Some(k), Some(photo)) = (self.number.get(o.point.as_str()), photo_number.get(o.photo.as_str())) {
                rays[*k].push(*photo);
            }
        }
        scene.ray_start.push(0);
        for of_point in rays {
            scene.ray_photos.extend(of_point);
            scene.ray_start.push(scene.ray_photos.len() as u32);
        }
    }

    /// Labels of control points that were not used.
    fn add_unused_control(&self, scene: &mut Scene) {
        let not_used = self.adjustment.left_out.iter();
        for item in not_used.filter(|item| item.kind == LeftOutKind::Control && item.given.is_none()) {
            let point = item.point.as_deref().and_then(|id| self.project.points.iter().find(|p| p.id == id));
            if let Some((id, given)) = point.and_then(|p| Some((&p.id, p.xyz?))) {
                // At the adjusted coordinates, or else at the given ones.
                let words = format!("{id}: {}", text::not_used_cell());
                let place = self.at(id).unwrap_or_else(|| self.about(given));
                scene.labels.push(SceneLabel { words, place, chosen: false, warning: true });
            }
        }
    }

    fn add_lines(&self, scene: &mut Scene) {
        let colours: HashMap<&str, [u8; 3]> = self.project.layers.iter().map(|l| (l.id.as_str(), l.colour)).collect();
        for line in &self.project.lines {
            if let (Some(from), Some(to)) = (self.at(&line.from), self.at(&line.to)) {
                scene.lines.extend(from.into_iter().chain(to));
                scene.line_colours.extend(colours.get(line.layer.as_str()).copied().unwrap_or_default());
            }
        }
    }

    fn add_distances(&self, scene: &mut Scene) {
        for distance in &self.project.distances {
            if let (Some(from), Some(to)) = (self.at(&distance.from), self.at(&distance.to)) {
                scene.distances.extend(from.into_iter().chain(to));
                let length = format::fixed(distance.length, format::decimals_for(distance.sigma));
                scene.labels.push(SceneLabel {
                    words: format!("{} – {}  {length}", distance.from, distance.to),
                    place: std::array::from_fn(|k| 0.5 * (from[k] + to[k])),
                    chosen: false,
                    warning: false,
                });
            }
        }
    }

    /// Differences at check and control points.
    fn add_differences(&self, scene: &mut Scene) {
        let mut add = |id: &str, difference: [f64; 3]| {
            if let Some(place) = self.at(id) {
                scene.residuals.extend(place.into_iter().chain(difference.map(|d| d as f32)));
            }
        };
        for check in &self.adjustment.check_points {
            check.difference.into_iter().for_each(|d| add(&check.id, d));
        }
        for point in self.project.points.iter().filter(|p| p.role == Role::Control) {
            if let (Some(given), Some(k)) = (point.xyz, self.number.get(point.id.as_str())) {
                let found = self.adjustment.points[*k].xyz;
                let difference: [f64; 3] = std::array::from_fn(|a| found[a] - given[a]);
                if difference.iter().any(|d| *d != 0.0) {
                    add(&point.id, difference);
                }
            }
        }
    }

    /// Features, and the deviations of the chosen one.
    fn add_features(&self, scene: &mut Scene, chosen: Option<&str>) {
        let features = &self.adjustment.features;
        for feature in features.iter().filter(|f| f.error.is_none()) {
            let own = feature.residuals.iter().filter_map(|r| self.number.get(r.point.as_str()));
            let own: Vec<[f64; 3]> = own.map(|k| self.adjustment.points[*k].xyz).collect();
            self.add_form(scene, feature, &own, chosen == Some(feature.id.as_str()));
        }
        if let Some(feature) = chosen.and_then(|id| features.iter().find(|f| f.id == id)) {
            self.add_deviations(scene, feature);
        }
    }

    /// A feature's outline, its surface and its name.
    fn add_form(&self, scene: &mut Scene, feature: &MeasuredFeature, points: &[[f64; 3]], chosen: bool) {
        let drawn = drawn(feature, points);
        scene.forms.extend(drawn.outline.into_iter().flatten().flat_map(|xyz| self.about(xyz)));
        let surface = if chosen { &mut scene.chosen_surface } else { &mut scene.surfaces };
        surface.extend(drawn.surface.into_iter().flatten().flat_map(|xyz| self.about(xyz)));
        let Some(place) = drawn.label else { return };
        // What a length or an angle is stands with it; of the others the panel has it.
        let shown = feature.value.filter(|_| matches!(feature.kind.as_str(), "distance" | "angle")).map(|value| {
            let angle = feature.quantity == Some(Quantity::Angle);
            let shown = |x: f64| if angle { x.to_degrees() } else { x };
            let decimals = feature.sigma.map(shown).filter(|s| *s > 0.0).map_or(3, format::decimals_for);
            format!("  {}{}", format::fixed(shown(value), decimals), if angle { "°" } else { "" })
        });
        let words = format!("{}{}", feature.id, shown.unwrap_or_default());
        scene.labels.push(SceneLabel { words, place: self.about(place), chosen, warning: false });
    }

    /// Deviations of a feature's points as vectors across the form.
    fn add_deviations(&self, scene: &mut Scene, feature: &MeasuredFeature) {
        let on = self.project.features.iter().find(|f| f.id == feature.id).and_then(|f| match &f.kind {
            sightline::project::FeatureKind::Deviations { feature, .. } => feature.clone(),
            _ => Some(f.id.clone()),
        });
        let form = on.and_then(|id| self.adjustment.features.iter().find(|f| f.id == id));
        let mut seen = BTreeSet::new();
        for residual in feature.residuals.iter().filter(|r| seen.insert(r.point.as_str())) {
            let Some(place) = self.at(&residual.point) else { continue };
            let vector = residual.difference.or_else(|| {
                let form = form?;
                let v = add(place.map(f64::from), -1.0, self.about(form.position?).map(f64::from));
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
}

/// Exaggerations that suit a result: of its ellipsoids, and of the vectors in its scene.
pub fn factors(result: &AdjustmentResult, scene: &Scene) -> (f64, f64) {
    let sigmas = result.adjustment.points.iter().filter_map(|p| p.sigma).map(|[x, y, z]| x.max(y).max(z));
    let length = |v: &[f32]| v[3..6].iter().map(|x| f64::from(*x).powi(2)).sum::<f64>().sqrt();
    let vectors = scene.residuals.chunks_exact(6).chain(scene.sticks.chunks_exact(6)).map(length);
    (exaggeration(sigmas, scene.size), 3.0 * exaggeration(vectors, scene.size))
}

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

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use sightline::adjustment::{AdjustedObservation, AdjustedPhoto, AdjustedPoint};
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
        let result = AdjustmentResult { input: input.clone(), oriented: input, adjustment };
        let scene = scene(&result, &project, None);
        assert_eq!(scene.points, [-50.0, 0.0, 0.0, 50.0, 0.0, 0.0]);
        assert_eq!(scene.roles, [5, 4]);
        assert_eq!((scene.ray_start, scene.ray_photos), (vec![0, 0, 1], vec![0]));
        assert_eq!((scene.photos.len(), scene.ellipsoids.len(), scene.residuals.len()), (15, 18, 6));
        assert_eq!(&scene.residuals[3..], [0.0, 0.0, -0.5]);
        assert_eq!(scene.grid, 10.0);
    }
}
