//! What each photo of a network sees, and the project that results.

use nalgebra::Vector3;

use super::{Bar, Network, NetworkPoint, Source, Station};
use crate::camera::pixel_from_camera_point;
use crate::detect::detect;
use crate::detection::Target;
use crate::error::{Error, Place, Reason, Result, Thing};
use crate::image::Grey;
use crate::initial::Pose;
use crate::noise::Noise;
use crate::project::{Camera, Distance, Observation, Photo, Point, Project, Role, Sigma};
use crate::render::render;
use crate::rotation;
use crate::scene::{Disc, Scene, incidence};

/// Grey of a target whose grey is not given.
const WHITE: f64 = 0.85;

/// The project a network gives: cameras, photos and points at their true values, and the observations of every point
/// that a photo sees.
///
/// A photo sees a point that lies in front of the camera and within the picture (less `margin`), is not hidden by a
/// face, and, if it faces a direction, is met under `max_incidence`. Noise comes from the seed, station by station, so
/// that adding a photo leaves the others as they were.
///
/// # Errors
/// [`Error::Unknown`] and [`Error::Duplicate`] for identifiers, [`Error::Invalid`] for impossible numbers, and what
/// [`render`] and [`detect`] say.
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
/// [`Error::Unknown`] when there is no such station, and what [`render`] says.
pub fn photo(network: &Network, station: &str) -> Result<Grey> {
    let unknown = || Error::Unknown { kind: Thing::Photo, name: station.into(), at: Place::field("stations") };
    let index = network.stations.iter().position(|s| s.id == station).ok_or_else(unknown)?;
    let station = &network.stations[index];
    render(camera_of(network, station)?, &station.pose()?, &scene(network), &network.exposure, index as u64)
}

/// What the photos of a network are rendered from.
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

/// A point as a photo sees it.
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
        let faces_us = point.normal.is_none_or(|n| incidence(pose, &xyz, &n.into()) <= network.max_incidence);
        (faces_us && !scene.hides(&pose.centre, &xyz)).then_some(Seen { point, pixel, sigma: network.sigma })
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

/// The detected target of each point: the nearest to its projection, within a quarter of its diameter and 1.5 pixels
/// for what eccentricity and noise shift it.
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

/// The project's points. Given coordinates are off by their standard errors unless everything is exact.
fn points(network: &Network) -> Vec<Point> {
    // A stream of its own, which no photo uses.
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
        // Projected centres have no eccentricity that a diameter could explain.
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

/// What the project does not hold and its own validation therefore does not see.
fn check(network: &Network) -> Result<()> {
    let invalid = |reason, field: &str| Err(Error::Invalid { reason, at: Place::field(field) });
    if network.noise.is_some_and(|n| n.both().into_iter().any(|s| !s.is_finite() || s < 0.0)) {
        return invalid(Reason::Noise, "noise");
    }
    if !network.margin.is_finite() {
        return invalid(Reason::Margin, "margin");
    }
    if !network.max_incidence.is_finite() {
        return invalid(Reason::Incidence, "max_incidence");
    }
    Ok(())
}
