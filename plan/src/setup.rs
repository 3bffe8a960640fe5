//! A plan prepared for prediction: checked, with the points that each station sees.

use crate::reason::PlanReason;
use std::collections::HashMap;

use nalgebra::Vector3;

use crate::network::Station;
use crate::scene::{Face, Scene};
use sightline::adjust::Numbering;
use sightline::error::{Error, Place, Reason, Result, Thing};
use sightline::initial::Pose;
use sightline::limits;
use sightline::project::{Camera, DatumKind, Distance, Observation, Photo, Plan, PlanStation, Project, Role, Sigma};
use sightline::rotation;

use super::Unseen;
use super::sight::{Hindrance, see};

/// Lengths and coordinates are below this: what is computed of them stays finite.
pub const LARGEST: f64 = 1e100;

/// The plan with everything that does not depend on its stations.
pub struct Setup<'a> {
    pub plan: &'a Plan,
    pub scene: Scene,
    /// Places of the points.
    pub places: Vec<Vector3<f64>>,
    /// Whether a point's coordinates are given: it needs no rays and is not judged.
    pub given: Vec<bool>,
    pub index: HashMap<&'a str, usize>,
}

/// A photo that could be taken.
#[derive(Clone, Debug)]
pub struct Shot {
    pub station: PlanStation,
    /// Place of its camera in the plan.
    pub camera: usize,
    pub pose: Pose,
    /// Points that it sees, with their pixels.
    pub seen: Vec<(usize, [f64; 2])>,
    pub unseen: Unseen,
    pub smallest_px: Option<f64>,
    pub forbidden: bool,
}

impl<'a> Setup<'a> {
    /// Checks a plan.
    ///
    /// # Errors
    /// As [`super::predict`].
    pub fn new(plan: &'a Plan) -> Result<Self> {
        check(plan)?;
        let face = |f: &sightline::project::PlanFace| Face {
            corner: f.corner,
            along: f.along,
            across: f.across,
            grey: 0.0,
            texture: 0.0,
            grain: 1.0,
        };
        let scene = Scene { faces: plan.faces.iter().map(face).collect(), ..Scene::default() };
        scene.check()?;
        let controlled = plan.datum.kind == DatumKind::Control;
        let setup = Self {
            plan,
            scene,
            places: plan.points.iter().map(|p| Vector3::from(p.xyz.unwrap_or_default())).collect(),
            given: plan.points.iter().map(|p| controlled && p.role == Role::Control).collect(),
            index: plan.points.iter().enumerate().map(|(k, p)| (p.id.as_str(), k)).collect(),
        };
        Ok(setup)
    }

    /// Points visible from a station.
    ///
    /// # Errors
    /// [`Error::Unknown`] for its camera, [`Error::Invalid`] for its place and direction.
    pub fn shot(&self, station: &PlanStation) -> Result<Shot> {
        let camera = match station.camera.as_str() {
            "" => 0,
            id => self.plan.cameras.iter().position(|c| c.id == id).ok_or_else(|| Error::Unknown {
                kind: Thing::Camera,
                name: id.to_owned(),
                at: Place::photo(&station.id),
            })?,
        };
        let pose = pose(station)?;
        let mut shot = Shot {
            station: station.clone(),
            camera,
            pose,
            seen: Vec::new(),
            unseen: Unseen::default(),
            smallest_px: None,
            forbidden: self.is_forbidden(&station.position),
        };
        for k in 0..self.places.len() {
            match see(self, &self.plan.cameras[camera], &pose, k) {
                Ok((pixel, across)) => {
                    shot.seen.push((k, pixel));
                    if let Some(across) = across {
                        shot.smallest_px = Some(shot.smallest_px.map_or(across, |least| least.min(across)));
                    }
                }
                Err(Hindrance::Outside) => shot.unseen.outside += 1,
                Err(Hindrance::TurnedAway) => shot.unseen.turned_away += 1,
                Err(Hindrance::Hidden) => shot.unseen.hidden += 1,
                Err(Hindrance::TooSmall) => shot.unseen.too_small += 1,
                Err(Hindrance::Blurred) => shot.unseen.blurred += 1,
            }
        }
        Ok(shot)
    }

    pub fn is_forbidden(&self, place: &[f64; 3]) -> bool {
        let within = |r: &sightline::project::Region| (0..3).all(|a| place[a] > r.low[a] && place[a] < r.high[a]);
        self.plan.forbidden.iter().any(within)
    }

    /// The document of these photos and of the points selected by `takes_part`, and its numbering, by which it is read: stations of
    /// a search have no names of their own. `None` if no equations can be made of its numbers.
    pub fn numbered(&self, shots: &[&Shot], takes_part: &[bool]) -> Option<(Project, Numbering)> {
        let plan = self.plan;
        let mut next = 0..;
        let places: Vec<Option<usize>> = takes_part.iter().map(|part| part.then(|| next.next()).flatten()).collect();
        let place = |id: &str| self.index.get(id).and_then(|k| places[*k]);
        let mut project = Project { cameras: plan.cameras.clone(), datum: plan.datum.clone(), ..Project::default() };
        let mut numbering = Numbering::default();
        project.points =
            plan.points.iter().zip(takes_part).filter(|(_, part)| **part).map(|(p, _)| p.clone()).collect();
        for point in &mut project.points {
            // Projections of centres have no eccentricity.
            point.diameter = None;
        }
        if let Some(points) = &mut project.datum.points {
            points.retain(|id| place(id).is_some());
            numbering.datum = Some(points.iter().filter_map(|id| place(id)).collect());
        }
        let length = |from: &str, to: &str| (self.places[self.index[from]] - self.places[self.index[to]]).norm();
        for bar in &plan.distances {
            let (Some(from), Some(to)) = (place(&bar.from), place(&bar.to)) else { continue };
            numbering.ends.push([from, to]);
            project.distances.push(Distance {
                from: bar.from.clone(),
                to: bar.to.clone(),
                length: length(&bar.from, &bar.to),
                sigma: bar.sigma,
                check: false,
            });
        }
        for (n, shot) in shots.iter().enumerate() {
            for (k, [u, v]) in &shot.seen {
                let Some(point) = places[*k] else { continue };
                numbering.observations.push((n, point));
                project.observations.push(Observation {
                    photo: String::new(),
                    point: String::new(),
                    u: *u,
                    v: *v,
                    sigma: Sigma::One(plan.sigma),
                    enabled: true,
                    target: None,
                });
            }
            numbering.cameras.push(shot.camera);
            project.photos.push(Photo {
                id: shot.station.id.clone(),
                camera: plan.cameras[shot.camera].id.clone(),
                position: Some(shot.pose.centre.into()),
                rotation: Some(rotation::angles(&shot.pose.object_to_camera)),
                enabled: true,
                ..Photo::default()
            });
        }
        let sound = |x: &f64| x.abs() < LARGEST;
        let posed = |p: &Photo| p.position.iter().chain(&p.rotation).flatten().all(sound);
        let sound = project.photos.iter().all(posed)
            && project.observations.iter().all(|o| sound(&o.u) && sound(&o.v))
            && project.distances.iter().all(|d| d.length > 0.0 && sound(&d.length));
        sound.then_some((project, numbering))
    }
}

/// Exterior orientation of a station.
pub fn pose(station: &PlanStation) -> Result<Pose> {
    let PlanStation { id, position, look_at, rotation, roll, .. } = station.clone();
    Station { id, camera: String::new(), position, rotation, look_at, roll }.pose()
}

/// Principal distance in pixels.
pub fn principal_distance_px(camera: &Camera) -> Option<f64> {
    camera.principal_distance_px()
}

/// Room between the object and the border of the picture.
const ROOM: f64 = 1.04;

/// The distance from which an object of this radius fills the picture, with its margin.
pub fn fill_distance(camera: &Camera, margin: f64, radius: f64) -> f64 {
    let c = principal_distance_px(camera).unwrap_or(1.0);
    let short = f64::from(camera.width.min(camera.height)) / 2.0 - margin;
    ROOM * radius / (short.max(1.0) / c).atan().sin()
}

fn check(plan: &Plan) -> Result<()> {
    let invalid = |reason, field: &str| Err(Error::Invalid { reason, at: Place::field(field) });
    if plan.cameras.is_empty() {
        return invalid(PlanReason::PlanCamera.into(), "cameras");
    }
    if plan.points.len() * plan.stations.len().max(1) > limits::RAYS {
        return invalid(PlanReason::PlanTooLarge { limit: limits::RAYS }.into(), "points");
    }
    if !(plan.sigma > 0.0 && plan.sigma < 1e6) {
        return invalid(Reason::ImageSigma, "sigma");
    }
    if !(plan.max_incidence > 0.0 && plan.max_incidence < 1.571) {
        return invalid(PlanReason::Incidence.into(), "max_incidence");
    }
    if !plan.margin.is_finite() {
        return invalid(PlanReason::Margin.into(), "margin");
    }
    if !(plan.least_px >= 0.0 && plan.least_px.is_finite()) {
        return invalid(PlanReason::PlanLeastPixels.into(), "least_px");
    }
    let wanted = plan.wanted;
    if !(wanted.precision > 0.0 && wanted.precision.is_finite() && (0.5..=0.999).contains(&wanted.probability)) {
        return invalid(PlanReason::PlanWanted.into(), "wanted");
    }
    let positive = |value: Option<f64>| value.is_none_or(|value| value > 0.0 && value.is_finite());
    if !(positive(plan.lens.f_number)
        && positive(plan.lens.focus)
        && positive(Some(plan.lens.circle_px))
        && positive(Some(plan.lens.unit_mm)))
    {
        return invalid(PlanReason::PlanLens.into(), "lens");
    }
    let finite = |r: &sightline::project::Region| r.low.iter().chain(&r.high).all(|x| x.is_finite());
    if !plan.forbidden.iter().all(finite) {
        return invalid(Reason::NotFinite, "forbidden");
    }
    let distances = plan.distances.iter().map(|d| Distance {
        from: d.from.clone(),
        to: d.to.clone(),
        length: 1.0,
        sigma: d.sigma,
        check: false,
    });
    let project = Project {
        cameras: plan.cameras.clone(),
        points: plan.points.clone().into(),
        distances: distances.collect(),
        datum: plan.datum.clone(),
        ..Project::default()
    };
    project.validate()?;
    if let Some(point) = plan.points.iter().find(|p| p.xyz.is_none()) {
        return Err(Error::MissingInitialValues {
            photos: Vec::new(),
            points: vec![point.id.clone()],
            cameras: Vec::new(),
        });
    }
    if let Some(camera) = plan.cameras.iter().find(|c| principal_distance_px(c).is_none()) {
        return Err(Error::MissingInitialValues {
            photos: Vec::new(),
            points: Vec::new(),
            cameras: vec![camera.id.clone()],
        });
    }
    Ok(())
}
