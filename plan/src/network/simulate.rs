//! Simulation of a network: the observations of each photo, and the resulting project.

use crate::reason::PlanReason;
use nalgebra::Vector3;

use super::{Bar, Network, NetworkPoint, Source, Station};
use crate::render::render;
use crate::scene::{Disc, Scene, incidence};
use sightline::camera::pixel_from_camera_point;
use sightline::detect::detect;
use sightline::detection::Target;
use sightline::error::{Error, Place, Result, Thing};
use sightline::image::Grey;
use sightline::initial::Pose;
use sightline::noise::Noise;
use sightline::project::{Camera, Distance, Observation, Photo, Point, Project, Role, Sigma};
use sightline::rotation;

/// Grey level of a target without a given one, 0 (black) to 1 (white).
const WHITE: f64 = 0.85;

/// The project of a network: cameras, photos and points at their true values, and the observations of all points that are visible in a
/// photo.
///
/// A point is visible in a photo if it lies in front of the camera and within the image (without its `margin`), is not occluded by a face
/// and, if it has a normal, has an angle of incidence of at most `max_incidence`. The noise of each station has its own stream of the
/// seed, so that adding a photo does not change the others.
///
/// # Errors
/// [`Error::Unknown`] and [`Error::Duplicate`] for identifiers, [`Error::Invalid`] for impossible numbers, and the errors of [`render`]
/// and [`detect`].
pub fn simulate(network: &Network) -> Result<Project> {
    check(network)?;
    let scene = scene(network);
    let mut project = Project {
        name: network.name.clone(),
        unit: network.unit.clone(),
        cameras: network.cameras.clone(),
        points: points(network).into(),
        distances: network.distances.iter().map(|bar| distance(network, bar)).collect::<Result<_>>()?,
        datum: network.datum.clone(),
        ..Project::default()
    };
    for (index, station) in network.stations.iter().enumerate() {
        let camera = camera_of(network, station)?;
        let pose = station.pose()?;
        let mut seen = projections(network, &scene, camera, &pose);
        match network.observations {
            Source::Exact => {}
            Source::Noisy => disturb(network, index, &mut seen),
            Source::Rendered => {
                let picture = render(camera, &pose, &scene, &network.exposure, index as u64)?;
                seen = measured(network, &picture, seen)?;
            }
        }
        project.observations.extend(seen.into_iter().map(|s| Observation {
            photo: station.id.clone(),
            point: s.point.id.clone(),
            u: s.pixel[0],
            v: s.pixel[1],
            sigma: s.sigma,
            enabled: true,
            target: None,
        }));
        project.photos.push(Photo {
            id: station.id.clone(),
            camera: station.camera.clone(),
            file: format!("{}.png", station.id),
            position: Some(station.position),
            rotation: Some(rotation::angles(&pose.object_to_camera)),
            enabled: true,
            ..Photo::default()
        });
    }
    project.validate()?;
    Ok(project)
}

/// The photo of one station, rendered.
///
/// # Errors
/// [`Error::Unknown`] if there is no such station, and the errors of [`render`].
pub fn photo(network: &Network, station: &str) -> Result<Grey> {
    let unknown = || Error::Unknown { kind: Thing::Photo, name: station.into(), at: Place::field("stations") };
    let index = network.stations.iter().position(|s| s.id == station).ok_or_else(unknown)?;
    let station = &network.stations[index];
    render(camera_of(network, station)?, &station.pose()?, &scene(network), &network.exposure, index as u64)
}

/// The scene from which the photos of a network are rendered.
pub fn scene(network: &Network) -> Scene {
    let disc = |point: &NetworkPoint| {
        Some(Disc {
            id: point.id.clone(),
            centre: point.xyz,
            normal: point.normal?,
            diameter: point.diameter?,
            ring: point.ring,
            grey: point.grey.unwrap_or(WHITE),
            patch: point.patch,
        })
    };
    Scene {
        faces: network.faces.clone(),
        discs: network.points.iter().filter_map(disc).collect(),
        background: network.background,
    }
}

/// The image of a point in a photo.
struct Seen<'a> {
    point: &'a NetworkPoint,
    pixel: [f64; 2],
    sigma: Sigma,
}

fn projections<'a>(network: &'a Network, scene: &Scene, camera: &Camera, pose: &Pose) -> Vec<Seen<'a>> {
    let inside = |[u, v]: [f64; 2]| {
        let m = network.margin;
        u >= m && v >= m && u <= f64::from(camera.width) - m && v <= f64::from(camera.height) - m
    };
    let see = |point: &'a NetworkPoint| {
        let xyz = Vector3::from(point.xyz);
        let pixel = pixel_from_camera_point(camera, pose.to_camera(&xyz)).filter(|p| inside(*p))?;
        let faces_camera = point.normal.is_none_or(|n| incidence(pose, &xyz, &n.into()) <= network.max_incidence);
        (faces_camera && !scene.hides(&pose.centre, &xyz)).then_some(Seen { point, pixel, sigma: network.sigma })
    };
    network.points.iter().filter_map(see).collect()
}

fn disturb(network: &Network, index: usize, seen: &mut [Seen]) {
    let mut noise = Noise::new(network.seed, index as u64);
    let size = network.noise.unwrap_or(network.sigma).both();
    for s in seen {
        s.pixel = [0, 1].map(|k| s.pixel[k] + size[k] * noise.normal());
    }
}

/// The detected target of each point: the nearest to its projection, within a quarter of its diameter plus 1.5 pixels for eccentricity
/// and noise.
fn measured<'a>(network: &Network, picture: &Grey, seen: Vec<Seen<'a>>) -> Result<Vec<Seen<'a>>> {
    let targets = detect(&picture.view()?, &network.detect)?.targets;
    let nearest = |s: &Seen| -> Option<&Target> {
        let distance = |t: &Target| (t.u - s.pixel[0]).hypot(t.v - s.pixel[1]);
        let target = targets.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        (distance(target) < 1.5 + target.minor / 4.0).then_some(target)
    };
    let measure = |s: Seen<'a>| {
        let target = nearest(&s)?;
        Some(Seen { pixel: [target.u, target.v], sigma: Sigma::Two([target.sigma_u, target.sigma_v]), ..s })
    };
    Ok(seen.into_iter().filter_map(measure).collect())
}

/// The project's points. Given coordinates have random errors according to their standard errors, unless the observations are exact.
fn points(network: &Network) -> Vec<Point> {
    // A separate stream of random numbers that no photo uses.
    let mut noise = Noise::new(network.seed, u64::MAX);
    let given = |point: &NetworkPoint, noise: &mut Noise| {
        let mut xyz = point.xyz;
        if network.observations != Source::Exact && point.role != Role::Tie {
            for (x, sigma) in xyz.iter_mut().zip(point.sigma.unwrap_or_default()) {
                *x += sigma.unwrap_or(0.0) * noise.normal();
            }
        }
        xyz
    };
    let rendered = network.observations == Source::Rendered;
    let point = |point: &NetworkPoint| Point {
        id: point.id.clone(),
        role: point.role,
        xyz: Some(given(point, &mut noise)),
        sigma: point.sigma,
        // Projected centres have no eccentricity, so a diameter would introduce a wrong correction.
        diameter: point.diameter.filter(|_| rendered),
        normal: None,
    };
    network.points.iter().map(point).collect()
}

fn distance(network: &Network, bar: &Bar) -> Result<Distance> {
    let end = |id: &str| {
        let unknown = || Error::Unknown { kind: Thing::Point, name: id.into(), at: Place::field("distances") };
        network.points.iter().find(|p| p.id == id).map(|p| Vector3::from(p.xyz)).ok_or_else(unknown)
    };
    let length = (end(&bar.from)? - end(&bar.to)?).norm();
    Ok(Distance { from: bar.from.clone(), to: bar.to.clone(), length, sigma: bar.sigma, check: false })
}

fn camera_of<'a>(network: &'a Network, station: &Station) -> Result<&'a Camera> {
    network.cameras.iter().find(|c| c.id == station.camera).ok_or_else(|| Error::Unknown {
        kind: Thing::Camera,
        name: station.camera.clone(),
        at: Place::photo(&station.id),
    })
}

/// Checks the values that are not part of the project and that its validation therefore does not check.
fn check(network: &Network) -> Result<()> {
    let invalid = |reason, field: &str| Err(Error::Invalid { reason, at: Place::field(field) });
    if network.noise.is_some_and(|n| n.both().into_iter().any(|s| !s.is_finite() || s < 0.0)) {
        return invalid(PlanReason::Noise.into(), "noise");
    }
    if !network.margin.is_finite() {
        return invalid(PlanReason::Margin.into(), "margin");
    }
    if !network.max_incidence.is_finite() {
        return invalid(PlanReason::Incidence.into(), "max_incidence");
    }
    Ok(())
}
