//! Plans from a planned network or from a measured project.

use crate::network::Network;
use sightline::initial::Pose;
use sightline::project::{Plan, PlanDistance, PlanFace, PlanStation, Point, Project};

/// The plan of a network on paper.
pub fn from_network(network: &Network) -> Plan {
    let points = network.points.iter().map(|point| Point {
        id: point.id.clone(),
        role: point.role,
        xyz: Some(point.xyz),
        sigma: point.sigma,
        diameter: point.diameter,
        normal: point.normal,
    });
    let stations = network.stations.iter().map(|station| PlanStation {
        id: station.id.clone(),
        camera: station.camera.clone(),
        position: station.position,
        look_at: station.look_at,
        rotation: station.rotation,
        roll: station.roll,
        taken: false,
    });
    let faces = network.faces.iter().map(|f| PlanFace { corner: f.corner, along: f.along, across: f.across });
    let [u, v] = network.sigma.both();
    Plan {
        cameras: network.cameras.clone(),
        points: points.collect(),
        faces: faces.collect(),
        distances: (network.distances.iter())
            .map(|bar| PlanDistance { from: bar.from.clone(), to: bar.to.clone(), sigma: bar.sigma })
            .collect(),
        datum: network.datum.clone(),
        stations: stations.collect(),
        sigma: u.max(v),
        max_incidence: network.max_incidence.min(1.57),
        margin: network.margin,
        // A simulated network has no minimum target size.
        least_px: 0.0,
        ..Plan::default()
    }
}

/// The plan of measuring a project's object again, with the photos that were taken as its stations: points and photos that
/// have coordinates.
pub fn from_project(project: &Project) -> Plan {
    let stations = project.photos.iter().filter(|photo| photo.enabled).filter_map(|photo| {
        Pose::of_photo(photo)?;
        Some(PlanStation {
            id: photo.id.clone(),
            camera: photo.camera.clone(),
            position: photo.position?,
            rotation: photo.rotation,
            ..PlanStation::default()
        })
    });
    let points: Vec<Point> = project.points.iter().filter(|point| point.xyz.is_some()).cloned().collect();
    let known = |id: &str| points.iter().any(|point| point.id == id);
    let distances = project
        .distances
        .iter()
        .filter(|d| !d.check && known(&d.from) && known(&d.to))
        .map(|d| PlanDistance { from: d.from.clone(), to: d.to.clone(), sigma: d.sigma });
    let mut datum = project.datum.clone();
    if let Some(ids) = &mut datum.points {
        ids.retain(|id| known(id));
    }
    let mut sigmas: Vec<f64> = project.observations.iter().map(|o| o.sigma.both()[0]).collect();
    sigmas.sort_by(f64::total_cmp);
    Plan {
        cameras: project.cameras.clone(),
        distances: distances.collect(),
        stations: stations.collect(),
        sigma: sigmas.get(sigmas.len() / 2).copied().unwrap_or(Plan::default().sigma),
        datum,
        points,
        ..Plan::default()
    }
}
