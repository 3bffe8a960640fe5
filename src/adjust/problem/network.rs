//! The document as the adjustment sees it: numbered blocks, observations sorted by point, coordinates reduced to their
//! centre and size so that nothing large is squared.

use std::collections::HashMap;

use crate::camera;
use crate::error::{Defect, Error, Lack, Result};
use crate::project::{Camera, DatumKind, Interior, Parameter, Project, Role};

use super::left_out::{Key, RejectedObservations};
use super::numbering::Numbering;
use super::rig::{self, Member};
use super::state::{ExteriorOrientation, Frame, State};

/// An image observation that takes part.
#[derive(Clone, Debug)]
pub struct ImageObservation {
    /// Index into [`Network::photos`].
    pub photo: usize,
    /// In the units of the camera's residuals.
    pub measured: [f64; 2],
    /// Reciprocal standard errors in those units.
    pub sqrt_weight: [f64; 2],
    /// Place in the document's observations.
    pub row: usize,
}

/// Observed coordinates with reciprocal standard errors, which are 0 for axes that were not observed.
pub type PriorCoordinates = [(f64, f64); 3];

/// A photo that takes part.
#[derive(Clone, Debug)]
pub struct PhotoBlock {
    /// Place in the document.
    pub index: usize,
    /// Index into [`Network::interiors`].
    pub interior: usize,
    /// Observed projection centre.
    pub prior: PriorCoordinates,
    /// Number of its rays.
    pub rays: usize,
}

/// An estimated parameter of an interior orientation.
#[derive(Clone, Copy, Debug)]
pub struct Estimated {
    /// Which.
    pub parameter: Parameter,
    /// Column in the model's derivatives.
    pub column: usize,
    /// Parameter change per unit of the scaled unknown.
    pub scale: f64,
    /// A priori value and reciprocal standard error (0: not observed).
    pub prior: (f64, f64),
}

/// An interior orientation that takes part.
#[derive(Clone, Debug)]
pub struct InteriorBlock {
    /// The camera's place in the document.
    pub camera: usize,
    /// The photo it belongs to alone (index into [`Network::photos`]), for cameras with one per photo.
    pub photo: Option<usize>,
    /// Its estimated parameters.
    pub estimated: Vec<Estimated>,
}

/// A point that takes part.
#[derive(Clone, Debug)]
pub struct PointBlock {
    /// Place in the document.
    pub index: usize,
    /// Its rays.
    pub rays: std::ops::Range<usize>,
    /// Axes that are held.
    pub fixed: [bool; 3],
    /// Given coordinates with their weights, in the frame of the adjustment.
    pub prior: PriorCoordinates,
    /// Whether it stays in the reduced normal equations, because a distance ties it to another point.
    pub kept: bool,
}

/// A measured distance.
#[derive(Clone, Debug)]
pub struct Bar {
    /// Place in the document.
    pub index: usize,
    /// Index into [`Network::points`].
    pub from: usize,
    /// Index into [`Network::points`].
    pub to: usize,
    /// Length in the frame of the adjustment.
    pub length: f64,
    /// Reciprocal standard error.
    pub sqrt_weight: f64,
}

/// The network.
#[derive(Clone, Debug)]
pub struct Network {
    /// Origin and unit of the coordinates inside.
    pub frame: Frame,
    /// Photos with at least one ray.
    pub photos: Vec<PhotoBlock>,
    /// Interior orientations of these photos.
    pub interiors: Vec<InteriorBlock>,
    /// Points with rays or distances.
    pub points: Vec<PointBlock>,
    /// Rays, sorted by point.
    pub rays: Vec<ImageObservation>,
    /// Distances whose ends both take part.
    pub bars: Vec<Bar>,
    /// Cameras of the rig beside its first one.
    pub rig: Vec<Member>,
    /// Kind of datum.
    pub datum: DatumKind,
    /// Points that define the datum, if the document names them.
    pub datum_points: Option<Vec<usize>>,
    /// Observations of other kinds than image coordinates that were left out.
    pub left_out: Vec<Key>,
}

fn interior_of(project: &Project, photo: usize, camera: &Camera) -> Interior {
    project.photos[photo].interior.filter(|_| camera.per_photo).unwrap_or(camera.interior)
}

impl Network {
    /// Numbers a valid document without the observations in `left_out`; also returns the initial values.
    ///
    /// # Errors
    /// [`Error::Empty`] without observations, [`Error::MissingInitialValues`], [`Error::RankDefect`] for points and
    /// photos with too few rays.
    pub fn new(project: &Project, numbering: &Numbering, left_out: &RejectedObservations) -> Result<(Self, State)> {
        let mut rays_of_point: Vec<Vec<(usize, usize)>> = vec![Vec::new(); project.points.len()];
        let mut rays_of_photo = vec![0; project.photos.len()];
        let mut mentioned = vec![false; project.points.len()];
        for (row, o) in project.observations.iter().enumerate() {
            let (photo, point) = numbering.observations[row];
            mentioned[point] = true;
            if o.enabled && project.photos[photo].enabled && !left_out.observations[row] {
                rays_of_point[point].push((photo, row));
                rays_of_photo[photo] += 1;
            }
        }
        if rays_of_photo.iter().all(|n| *n == 0) {
            return Err(Error::Empty { what: Lack::Observations });
        }
        let controlled = project.datum.kind == DatumKind::Control;
        // What is only compared, or only an initial value, is left out where it cannot be determined.
        for (point, rays) in project.points.iter().zip(&mut rays_of_point) {
            let only_compared = point.role == Role::Check || (point.role == Role::Control && !controlled);
            if only_compared && rays.len() < 2 {
                for (photo, _) in rays.drain(..) {
                    rays_of_photo[photo] -= 1;
                }
            }
        }
        let given = |point: usize| controlled && project.points[point].role == Role::Control;
        let takes_part: Vec<bool> = {
            let mut part: Vec<bool> = rays_of_point.iter().map(|r| !r.is_empty()).collect();
            let used = |k: &usize| !left_out.given.contains(&Key::Distance(*k));
            for (k, _) in project.distances.iter().enumerate().filter(|(k, d)| used(k) && !d.check) {
                for end in numbering.ends[k] {
                    part[end] |= given(end) && project.points[end].xyz.is_some();
                }
            }
            part
        };
        check_initial_values(project, numbering, &rays_of_photo, &takes_part)?;
        check_rays(project, &rays_of_point, &rays_of_photo, &mentioned, &takes_part, &given)?;

        let frame = Frame::around(
            project.points.iter().zip(&takes_part).filter(|(_, part)| **part).filter_map(|(p, _)| p.xyz),
            project.photos.iter().zip(&rays_of_photo).filter(|(_, n)| **n > 0).filter_map(|(p, _)| p.position),
        );
        let mut network = Self {
            frame,
            photos: Vec::new(),
            interiors: Vec::new(),
            points: Vec::new(),
            rays: Vec::new(),
            bars: Vec::new(),
            rig: Vec::new(),
            datum: project.datum.kind,
            datum_points: None,
            left_out: left_out.given.clone(),
        };
        let used = |key: Key| !left_out.given.contains(&key);
        let mut state = State::default();
        let mut place_of_photo = vec![usize::MAX; project.photos.len()];
        let mut shared = HashMap::new();
        for (k, photo) in project.photos.iter().enumerate().filter(|(k, _)| rays_of_photo[*k] > 0) {
            let at = network.photos.len();
            place_of_photo[k] = at;
            let c = numbering.cameras[k];
            let camera = &project.cameras[c];
            let mut add_interior = || {
                state.interiors.push(interior_of(project, k, camera));
                network.interiors.push(InteriorBlock {
                    camera: c,
                    photo: camera.per_photo.then_some(at),
                    estimated: estimated(camera, &interior_of(project, k, camera), |parameter| {
                        used(Key::Parameter(c, camera.per_photo.then_some(k), parameter))
                    }),
                });
                network.interiors.len() - 1
            };
            let interior =
                if camera.per_photo { add_interior() } else { *shared.entry(c).or_insert_with(add_interior) };
            let position = photo.position.unwrap_or_default();
            let mut prior = PriorCoordinates::default();
            if let (true, Some(sigma)) = (controlled, photo.sigma_position) {
                let inside = frame.inside(position);
                prior = std::array::from_fn(|a| match sigma[a] {
                    Some(s) if s > 0.0 && used(Key::Position(k, a)) => (inside[a], frame.scale / s),
                    _ => (0.0, 0.0),
                });
            }
            network.photos.push(PhotoBlock { index: k, interior, prior, rays: rays_of_photo[k] });
            state.poses.push(ExteriorOrientation::new(frame.inside(position), photo.rotation.unwrap_or_default()));
        }
        let mut place_of_point = vec![usize::MAX; project.points.len()];
        for (k, point) in project.points.iter().enumerate().filter(|(k, _)| takes_part[*k]) {
            place_of_point[k] = network.points.len();
            let xyz = frame.inside(point.xyz.unwrap_or_default());
            let (mut fixed, mut prior) = ([false; 3], PriorCoordinates::default());
            if given(k) {
                for a in 0..3 {
                    match point.sigma.and_then(|s| s[a]) {
                        Some(s) if s > 0.0 && used(Key::Control(k, a)) => prior[a] = (xyz[a], frame.scale / s),
                        Some(s) if s > 0.0 => {}
                        _ => fixed[a] = true,
                    }
                }
            }
            let first = network.rays.len();
            for &(photo, row) in &rays_of_point[k] {
                let o = &project.observations[row];
                let camera = &project.cameras[numbering.cameras[photo]];
                let unit = camera.residual_pitch();
                let sigma = o.sigma.both();
                network.rays.push(ImageObservation {
                    photo: place_of_photo[photo],
                    measured: camera::measurement_from_pixel(camera, [o.u, o.v]),
                    sqrt_weight: [1.0 / (sigma[0] * unit[0]), 1.0 / (sigma[1] * unit[1])],
                    row,
                });
            }
            let rays = first..network.rays.len();
            network.points.push(PointBlock { index: k, rays, fixed, prior, kept: false });
            state.points.push(xyz);
        }
        for (index, d) in project.distances.iter().enumerate() {
            let [from, to] = numbering.ends[index].map(|end| place_of_point[end]);
            if from != usize::MAX && to != usize::MAX && used(Key::Distance(index)) && !d.check {
                network.points[from].kept = true;
                network.points[to].kept = true;
                let (length, sqrt_weight) = (d.length / frame.scale, frame.scale / d.sigma);
                network.bars.push(Bar { index, from, to, length, sqrt_weight });
            }
        }
        if let Some(rig) = &project.rig {
            network.rig = rig::members(rig, &numbering.together, &place_of_photo, &frame);
        }
        network.datum_points = numbering.datum.as_ref().map(|points| {
            let places = points.iter().map(|point| place_of_point[*point]);
            places.filter(|p| *p != usize::MAX).collect()
        });
        Ok((network, state))
    }

    /// Room for the unknowns of an interior orientation: the largest number of them, made even; 0 to 12.
    pub fn interior_size(&self) -> usize {
        self.interiors.iter().map(|i| i.estimated.len()).max().unwrap_or(0).next_multiple_of(2)
    }

    /// Scalar observations of every kind.
    pub fn observations_count(&self) -> usize {
        let weighted = |prior: &PriorCoordinates| prior.iter().filter(|(_, w)| *w > 0.0).count();
        2 * self.rays.len()
            + self.bars.len()
            + self.rig.iter().map(Member::observations).sum::<usize>()
            + self.points.iter().map(|p| weighted(&p.prior)).sum::<usize>()
            + self.photos.iter().map(|p| weighted(&p.prior)).sum::<usize>()
            + self.interiors.iter().flat_map(|i| &i.estimated).filter(|e| e.prior.1 > 0.0).count()
    }

    /// Estimated parameters; fixed coordinates are none.
    pub fn unknowns(&self) -> usize {
        6 * self.photos.len()
            + self.interiors.iter().map(|i| i.estimated.len()).sum::<usize>()
            + self.points.iter().map(|p| p.fixed.iter().filter(|f| !**f).count()).sum::<usize>()
    }
}

/// The estimated parameters of a camera, with scales that make every unknown move an image point by about as much.
fn estimated(camera: &Camera, interior: &Interior, used: impl Fn(Parameter) -> bool) -> Vec<Estimated> {
    let [pitch_x, pitch_y] = camera.residual_pitch();
    let model = interior.model();
    let distance = interior.get(model.distance).unwrap_or(1.0);
    let radius = (f64::from(camera.width) * pitch_x).hypot(f64::from(camera.height) * pitch_y) / 2.0;
    // A change of the ideal image by `distance` at `radius`; the unit of normalised coordinates is the principal distance.
    let (effect, r) = if model.in_photo_units { (distance, radius) } else { (1.0, radius / distance) };
    let scale = |p: Parameter| match p {
        p if model.radial_power(p).is_some() => effect / r.powi(model.radial_power(p).unwrap_or(1)),
        Parameter::P1 | Parameter::P2 => effect / r.powi(2),
        Parameter::B1 | Parameter::B2 => effect / r,
        _ => distance,
    };
    let columns = interior.parameters();
    let wanted = camera.estimated();
    let columns = columns.iter().enumerate().filter(|(_, p)| wanted.contains(p));
    columns
        .map(|(column, &parameter)| Estimated {
            parameter,
            column,
            scale: scale(parameter),
            prior: match camera.sigma.get(&parameter).filter(|_| used(parameter)) {
                Some(sigma) => (camera.interior.get(parameter).unwrap_or_default(), 1.0 / sigma),
                None => (0.0, 0.0),
            },
        })
        .collect()
}

fn check_initial_values(
    project: &Project,
    numbering: &Numbering,
    rays_of_photo: &[usize],
    takes_part: &[bool],
) -> Result<()> {
    let (mut photos, mut points, mut cameras) = (Vec::new(), Vec::new(), Vec::new());
    for (k, photo) in project.photos.iter().enumerate().filter(|(k, _)| rays_of_photo[*k] > 0) {
        if photo.position.is_none() || photo.rotation.is_none() {
            photos.push(photo.id.clone());
        }
        let camera = &project.cameras[numbering.cameras[k]];
        if camera::Model::new(&camera.of_photo(photo).interior).is_none() && !cameras.contains(&camera.id) {
            cameras.push(camera.id.clone());
        }
    }
    for (point, _) in project.points.iter().zip(takes_part).filter(|(_, part)| **part) {
        if point.xyz.is_none() {
            points.push(point.id.clone());
        }
    }
    if photos.is_empty() && points.is_empty() && cameras.is_empty() {
        return Ok(());
    }
    Err(Error::MissingInitialValues { photos, points, cameras })
}

/// Points and photos that cannot be determined by counting alone.
fn check_rays(
    project: &Project,
    rays_of_point: &[Vec<(usize, usize)>],
    rays_of_photo: &[usize],
    mentioned: &[bool],
    takes_part: &[bool],
    given: &impl Fn(usize) -> bool,
) -> Result<()> {
    let too_few = |(k, point): &(usize, &crate::project::Point)| {
        let unmeasured = !mentioned[*k] && point.role == Role::Tie;
        unmeasured || (takes_part[*k] && !given(*k) && rays_of_point[*k].len() < 2)
    };
    let points: Vec<String> =
        project.points.iter().enumerate().filter(too_few).map(|(_, point)| point.id.clone()).collect();
    let control = project.datum.kind == DatumKind::Control;
    let lost = |(k, photo): &(usize, &crate::project::Photo)| {
        let observed = photo.sigma_position.filter(|_| control).into_iter().flatten();
        let observed = observed.filter(|s| s.is_some_and(|s| s > 0.0)).count();
        rays_of_photo[*k] > 0 && 2 * rays_of_photo[*k] + observed < 6
    };
    let photos: Vec<String> = project.photos.iter().enumerate().filter(lost).map(|(_, p)| p.id.clone()).collect();
    let mut defects = Vec::new();
    if !points.is_empty() {
        defects.push(Defect::TooFewRays { points });
    }
    if !photos.is_empty() {
        defects.push(Defect::PhotoUndetermined { photos });
    }
    if defects.is_empty() { Ok(()) } else { Err(Error::RankDefect { defects }) }
}
