//! Code shared by the readers and writers of cameras of other programs.
//!
//! A reader gives the model as its file has it; here it becomes a camera of the document, exactly where a model of the engine has all its
//! terms, by least squares ([`conversion`](super::conversion)) otherwise. A writer names the models of its format; here one of them takes the
//! values of the document's camera.

use crate::reason::ExchangeReason;
use std::collections::BTreeMap;

use nalgebra::Matrix3;
use serde::{Deserialize, Serialize};

use super::Files;
use super::conversion::{self, Covariance, LARGEST_PX, Side, WARNING_PX};
use super::lens::{Lens, LensModel, term};
use sightline::error::{Error, Place, Reason, Result};
pub use sightline::project::{Assumed, Ignored};
use sightline::project::{Camera, Conversion, Interior, Parameter, Project};
use sightline::rotation;

/// Assumptions of a reader, and the contents it ignored.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Notes {
    /// Assumptions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub assumed: Vec<Assumed>,
    /// Contents that are not imported.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ignored: Vec<Ignored>,
}

impl Notes {
    /// Notes an assumption, once.
    pub fn assume(&mut self, assumed: Assumed) {
        if !self.assumed.contains(&assumed) {
            self.assumed.push(assumed);
        }
    }

    /// Counts things that are not kept.
    pub fn ignore(&mut self, name: &str, count: usize) {
        if count == 0 {
            return;
        }
        match self.ignored.iter_mut().find(|ignored| ignored.name == name) {
            Some(ignored) => ignored.count += count,
            None => self.ignored.push(Ignored { name: sightline::error::shortened(name), count }),
        }
    }
}

/// An exterior orientation in a camera frame of x right, y down, z forwards, as nearly all other programs have it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Object to camera.
    pub rotation: Matrix3<f64>,
    /// Projection centre in the object system.
    pub position: [f64; 3],
}

/// y and z the other way.
fn turned_over(m: &Matrix3<f64>) -> Matrix3<f64> {
    Matrix3::from_diagonal(&nalgebra::Vector3::new(1.0, -1.0, -1.0)) * m
}

impl Pose {
    /// From a rotation object to camera and the translation t of x_camera = R X + t; `None` if R Rᵀ differs from the identity by 0.001 or more.
    pub fn new(rotation: Matrix3<f64>, translation: [f64; 3]) -> Option<Self> {
        let translation = nalgebra::Vector3::from(translation);
        let finite = rotation.iter().chain(translation.iter()).all(|value| value.is_finite());
        let error = (rotation * rotation.transpose() - Matrix3::identity()).amax();
        if !finite || !(error < 1e-3) || rotation.determinant() < 0.0 {
            return None;
        }
        // Files round R, so that it is not exactly orthogonal; the three angles need the nearest rotation.
        let rotation = if error > 1e-13 { rotation::nearest(&rotation) } else { rotation };
        Some(Self { rotation, position: (-(rotation.transpose() * translation)).into() })
    }

    /// From a rotation object to camera and the projection centre.
    pub fn at(rotation: Matrix3<f64>, position: [f64; 3]) -> Option<Self> {
        let translation = -(rotation * nalgebra::Vector3::from(position));
        let pose = Self::new(rotation, translation.into())?;
        Some(Self { position, ..pose })
    }

    /// From a quaternion (w, x, y, z), object to camera, of any length above 0, and a translation.
    pub fn of_quaternion([w, x, y, z]: [f64; 4], translation: [f64; 3]) -> Option<Self> {
        let quaternion = nalgebra::Quaternion::new(w, x, y, z);
        if !(quaternion.norm() > 1e-6 && quaternion.norm().is_finite()) {
            return None;
        }
        let rotation = nalgebra::UnitQuaternion::from_quaternion(quaternion).to_rotation_matrix();
        Self::new(*rotation.matrix(), translation)
    }

    /// Of a photo of the document.
    pub fn of(position: [f64; 3], angles: [f64; 3]) -> Self {
        Self { rotation: turned_over(&rotation::object_to_camera(angles)), position }
    }

    /// Omega, phi, kappa of the document.
    pub fn angles(&self) -> [f64; 3] {
        rotation::angles(&turned_over(&self.rotation))
    }

    /// t of x_camera = R X + t.
    pub fn translation(&self) -> [f64; 3] {
        (-(self.rotation * nalgebra::Vector3::from(self.position))).into()
    }

    /// Quaternion (w, x, y, z) with w from 0.
    pub fn quaternion(&self) -> [f64; 4] {
        let rotation = nalgebra::Rotation3::from_matrix_unchecked(self.rotation);
        let q = nalgebra::UnitQuaternion::from_rotation_matrix(&rotation);
        let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
        [sign * q.w, sign * q.i, sign * q.j, sign * q.k]
    }

    /// Rotation vector: axis times angle in radians.
    pub fn rotation_vector(&self) -> [f64; 3] {
        nalgebra::Rotation3::from_matrix_unchecked(self.rotation).scaled_axis().into()
    }
}

/// A model as its file has it.
#[derive(Clone, Debug)]
pub enum ForeignModel {
    /// Ideal to image.
    Lens(&'static LensModel, Lens),
    /// A camera of the document already, and pixel to direction (a, b) where that has more terms.
    Correction(Camera, Option<Correction>),
}

/// A correction of the measured point in pixels, y down, whose centre may be another than the principal point.
#[derive(Clone, Debug, PartialEq)]
pub struct Correction {
    /// Principal distance in pixels.
    pub f: f64,
    /// Principal point.
    pub pp: [f64; 2],
    /// Centre of the distortion.
    pub centre: [f64; 2],
    /// Coefficients of r², r⁴, ...
    pub radial: Vec<f64>,
    /// P1, P2, b1, b2.
    pub rest: [f64; 4],
}

impl Correction {
    /// Direction (a, b), b down.
    pub fn direction(&self, [u, v]: [f64; 2]) -> Option<[f64; 2]> {
        let (x, y) = (u - self.centre[0], v - self.centre[1]);
        let r2 = x * x + y * y;
        let radial = self.radial.iter().rev().fold(0.0, |sum, k| (sum + k) * r2);
        let [p1, p2, b1, b2] = self.rest;
        let dx = x * radial + p1 * (r2 + 2.0 * x * x) + 2.0 * p2 * x * y + b1 * x + b2 * y;
        let dy = y * radial + p2 * (r2 + 2.0 * y * y) + 2.0 * p1 * x * y;
        let direction = [(u + dx - self.pp[0]) / self.f, (v + dy - self.pp[1]) / self.f];
        direction.iter().all(|value| value.is_finite()).then_some(direction)
    }
}

/// A camera as its file has it.
#[derive(Clone, Debug)]
pub struct ForeignCamera {
    /// Identifier.
    pub id: String,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Model.
    pub model: ForeignModel,
    /// Where it stood.
    pub pose: Option<Pose>,
    /// Part of the picture in which it is valid.
    pub region: Option<Vec<[f64; 2]>>,
    /// Covariance of its parameters, in the names of its model.
    pub covariance: Option<Covariance>,
}

impl ForeignCamera {
    /// A camera of a model.
    pub fn new(id: impl Into<String>, size: [u32; 2], shape: &'static LensModel, lens: Lens) -> Self {
        let model = ForeignModel::Lens(shape, lens);
        Self { id: id.into(), size, model, pose: None, region: None, covariance: None }
    }
}

/// A side of a picture, in pixels, that no camera and no scan has: a number from here on is damage, in whatever format it stands.
pub const LONGEST_SIDE: u32 = 1_000_000;

/// A camera that was read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImportedCamera {
    /// The camera.
    pub camera: Camera,
    /// Remaining difference of the conversion of its model; `None` if nothing had to be converted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub conversion: Option<Conversion>,
    /// Covariance of its parameters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub covariance: Option<Covariance>,
    /// Part of the picture in which it is valid, a polygon of pixels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub region: Option<Vec<[f64; 2]>>,
    /// Projection centre, where the file has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position: Option<[f64; 3]>,
    /// Omega, phi, kappa in radians.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotation: Option<[f64; 3]>,
}

/// Choices of the conversion.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct CameraOptions {
    /// Covariance of the camera's parameters, written converted beside the camera.
    pub covariance: Option<Covariance>,
    /// Part of the picture that is used, a polygon of pixels; null: all of it.
    pub region: Option<Vec<[f64; 2]>>,
    /// Whether a difference of more than 1 px is accepted.
    pub convert: bool,
}

/// Judges a difference.
fn judged(conversion: Conversion, convert: bool) -> Result<Conversion> {
    if conversion.max_px > LARGEST_PX && !convert {
        let reason = ExchangeReason::ConversionTooLarge { max_px: conversion.max_px.into() }.into();
        return Err(Error::Invalid { reason, at: Place::camera(&conversion.camera) });
    }
    Ok(conversion)
}

/// The camera of the document that a foreign one is, over the region that is used, given or the file's own.
///
/// # Errors
/// [`ExchangeReason::ConversionTooLarge`], [`ExchangeReason::ConversionFails`], and what makes no camera of the document.
pub fn settled(foreign: &ForeignCamera, used: Option<&[[f64; 2]]>, convert: bool) -> Result<ImportedCamera> {
    let [width, height] = foreign.size;
    if width.max(height) >= LONGEST_SIDE {
        let reason = ExchangeReason::ExpectedHere {
            expected: "width and height in pixels".into(),
            found: format!("{width} {height}"),
        }
        .into();
        return Err(Error::Invalid { reason, at: Place::camera(&foreign.id) });
    }
    let region = used.map(<[_]>::to_vec).or_else(|| foreign.region.clone());
    let region = region.unwrap_or_else(|| conversion::whole(foreign.size));
    conversion::check_region(&region)?;
    let camera = |interior| Camera::new(foreign.id.clone(), width, height, interior);
    let (found, conversion, covariance) = match &foreign.model {
        ForeignModel::Correction(camera, None) => (camera.clone(), None, None),
        ForeignModel::Correction(near, Some(correction)) => {
            let direction = |pixel| correction.direction(pixel);
            let (found, conversion) = best(foreign, std::slice::from_ref(near), &region, &direction)?;
            (found, Some(judged(conversion, convert)?), None)
        }
        ForeignModel::Lens(shape, lens) => {
            let direction = |pixel| lens.direction(pixel);
            let (found, conversion) = match lens.interior() {
                Some(interior) => (camera(interior), None),
                None => {
                    let (found, conversion) = best(
                        foreign,
                        &[camera(near_opencv(lens)), camera(near_brown(lens, foreign.size))],
                        &region,
                        &direction,
                    )?;
                    (found, Some(judged(conversion, convert)?))
                }
            };
            let carried = foreign.covariance.as_ref().map(|covariance| {
                if conversion.is_none() && same_parameters(shape, &found) {
                    return Ok(covariance.clone());
                }
                let from = Side::Lens(shape, remainder(shape, lens));
                let from_values = nearest_values(shape, &Lens::default(), lens);
                let to = Side::Engine(found.clone());
                let to_values = Side::values(&found);
                conversion::carried(covariance, (&from, &from_values), (&to, &to_values), &region, &direction)
            });
            (found, conversion, carried.transpose()?)
        }
    };
    Project { cameras: vec![found.clone()], ..Project::default() }.validate()?;
    let pose = foreign.pose;
    Ok(ImportedCamera {
        camera: found,
        conversion,
        covariance,
        region: foreign.region.clone(),
        position: pose.map(|pose| pose.position),
        rotation: pose.map(|pose| pose.angles()),
    })
}

/// Whether a model that holds a camera exactly names its parameters as the engine does, so that a covariance needs no conversion: the rays of a
/// fisheye, among them those beside and behind it, have no common image plane to convert over.
fn same_parameters(shape: &LensModel, camera: &Camera) -> bool {
    let own = Side::Engine(camera.clone()).names();
    shape.equidistant && shape.names().iter().all(|name| own.contains(name)) && own.len() == shape.parameters.len()
}

/// The terms of a lens that no parameter of a model moves.
fn remainder(shape: &LensModel, lens: &Lens) -> Lens {
    let values = nearest_values(shape, &Lens::default(), lens);
    let moved = shape.lens(&Lens::default(), &values);
    let mut left = *lens;
    left.terms.iter_mut().zip(moved.terms).for_each(|(term, moved)| *term -= moved);
    left
}

/// Values of a model that come near a lens: each parameter takes its first term.
fn nearest_values(shape: &LensModel, base: &Lens, lens: &Lens) -> Vec<f64> {
    let mut left = *lens;
    left.terms.iter_mut().zip(base.terms).for_each(|(term, base)| *term -= base);
    shape
        .parameters
        .iter()
        .map(|(_, terms)| {
            let value = left.terms[terms[0]];
            terms.iter().for_each(|term| left.terms[*term] -= value);
            value
        })
        .collect()
}

fn near_opencv(lens: &Lens) -> Interior {
    let lens = &across(lens, false);
    let t = &lens.terms;
    Interior::Opencv {
        fx: Some(t[term::FX]),
        fy: Some(t[term::FY]),
        cx: t[term::CX],
        cy: t[term::CY],
        k1: t[term::K1] - t[term::D1],
        k2: 0.0,
        p1: t[term::P1],
        p2: t[term::P2],
        k3: 0.0,
    }
}

/// A brown model in pixels near a lens, without distortion.
pub fn near_brown(lens: &Lens, [width, height]: [u32; 2]) -> Interior {
    let t = &lens.terms;
    let mut interior = Interior::brown(t[term::FY]);
    if let Interior::Brown { x0, y0, b1, .. } = &mut interior {
        *x0 = t[term::CX] - f64::from(width) / 2.0;
        *y0 = f64::from(height) / 2.0 - t[term::CY];
        *b1 = t[term::FY] / t[term::FX] - 1.0;
    }
    interior
}

/// The best fit of several models of the engine.
fn best(
    foreign: &ForeignCamera,
    near: &[Camera],
    region: &[[f64; 2]],
    direction: &dyn Fn([f64; 2]) -> Option<[f64; 2]>,
) -> Result<(Camera, Conversion)> {
    let from = match &foreign.model {
        ForeignModel::Lens(shape, _) => shape.name,
        ForeignModel::Correction(..) => "correction",
    };
    let fits = near.iter().filter_map(|camera| {
        let side = Side::Engine(camera.clone());
        let fitted = conversion::fit(&side, &Side::values(camera), region, direction)?;
        Some((Side::camera(camera, &fitted.values), fitted))
    });
    let best = fits.min_by(|(_, a), (_, b)| a.max_px.total_cmp(&b.max_px));
    let (camera, fitted) = best.ok_or_else(|| Error::Invalid {
        reason: ExchangeReason::ConversionFails { model: from.into() }.into(),
        at: Place::camera(&foreign.id),
    })?;
    let conversion = Conversion {
        camera: foreign.id.clone(),
        from: from.into(),
        to: conversion::model_name(&camera).into(),
        max_px: fitted.max_px,
        rms_px: fitted.rms_px,
        region: region.to_vec(),
        warning: fitted.max_px > WARNING_PX,
    };
    Ok((camera, conversion))
}

/// A camera of the document in a model of another program.
#[derive(Clone, Debug)]
pub struct Outgoing {
    /// Model.
    pub shape: &'static LensModel,
    /// Values of its parameters.
    pub values: Vec<f64>,
    /// The lens they give.
    pub lens: Lens,
    /// Remaining difference of the conversion; `None` if nothing had to be converted.
    pub conversion: Option<Conversion>,
    /// Covariance of the parameters.
    pub covariance: Option<Covariance>,
}

/// Takes the first of several models that is exact, else the first that leaves no more than 0.05 px, else the nearest; terms that no parameter
/// moves are those of `base`.
///
/// # Errors
/// [`Error::MissingInitialValues`] without a principal distance, [`ExchangeReason::ConversionTooLarge`], [`ExchangeReason::ConversionFails`],
/// [`ExchangeReason::RegionShape`], [`ExchangeReason::CovarianceShape`].
pub fn outgoing(
    camera: &Camera,
    shapes: &[&'static LensModel],
    base: &Lens,
    options: &CameraOptions,
) -> Result<Outgoing> {
    let whole = || conversion::whole([camera.width, camera.height]);
    let region = options.region.clone().unwrap_or_else(whole);
    conversion::check_region(&region)?;
    let start = undistorted(camera)?;
    let direction = |pixel| conversion::direction_of(camera, pixel);
    let exact =
        Lens::of(camera).and_then(|lens| shapes.iter().find_map(|shape| Some((*shape, shape.exact(base, &lens)?))));
    let (shape, values, conversion) = match exact {
        Some((shape, values)) => (shape, values, None),
        None => {
            let mut best: Option<(&'static LensModel, conversion::Fitted)> = None;
            for shape in shapes {
                let near = nearest_values(shape, base, &across(&start, shape.equidistant));
                let Some(fitted) = conversion::fit(&Side::Lens(shape, *base), &near, &region, &direction) else {
                    continue;
                };
                let enough = fitted.max_px <= WARNING_PX;
                if best.as_ref().is_none_or(|(_, other)| fitted.max_px < other.max_px) {
                    best = Some((shape, fitted));
                }
                if enough {
                    break;
                }
            }
            let model = conversion::model_name(camera);
            let (shape, fitted) = best.ok_or_else(|| Error::Invalid {
                reason: ExchangeReason::ConversionFails { model: model.into() }.into(),
                at: Place::camera(&camera.id),
            })?;
            let conversion = Conversion {
                camera: camera.id.clone(),
                from: model.into(),
                to: shape.name.into(),
                max_px: fitted.max_px,
                rms_px: fitted.rms_px,
                region: region.clone(),
                warning: fitted.max_px > WARNING_PX,
            };
            (shape, fitted.values, Some(judged(conversion, options.convert)?))
        }
    };
    let covariance = options.covariance.as_ref().map(|covariance| {
        if conversion.is_none() && same_parameters(shape, camera) {
            return Ok(single(covariance, camera));
        }
        let (side, held) = (Side::Engine(camera.clone()), Side::values(camera));
        let from = (&side, &held[..]);
        let to = (&Side::Lens(shape, *base), &values[..]);
        conversion::carried(&single(covariance, camera), from, to, &region, &direction)
    });
    let lens = shape.lens(base, &values);
    Ok(Outgoing { shape, lens, covariance: covariance.transpose()?, values, conversion })
}

/// A lens of the other kind near a lens: tan θ = θ + θ³/3.
fn across(lens: &Lens, equidistant: bool) -> Lens {
    if lens.equidistant == equidistant {
        return *lens;
    }
    let mut near = Lens { equidistant, ..Lens::default() };
    for k in [term::FX, term::FY, term::CX, term::CY] {
        near.terms[k] = lens.terms[k];
    }
    near.terms[term::K1] = lens.terms[term::K1] + if equidistant { 1.0 / 3.0 } else { -1.0 / 3.0 };
    near
}

/// The lens of a camera without its distortion where it is a correction, where a fit begins.
///
/// # Errors
/// [`Error::MissingInitialValues`] without a principal distance.
pub fn undistorted(camera: &Camera) -> Result<Lens> {
    let mut plain = camera.clone();
    if let Interior::Brown { k1, k2, k3, p1, p2, .. } = &mut plain.interior {
        for term in [k1, k2, k3, p1, p2] {
            *term = 0.0;
        }
    }
    Lens::of(&plain).ok_or_else(|| Error::MissingInitialValues {
        photos: Vec::new(),
        points: Vec::new(),
        cameras: vec![camera.id.clone()],
    })
}

/// A camera that was written.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExportedCamera {
    /// The files; where a covariance is given, one of them has it converted (`camera.covariance.json`).
    pub files: Files,
    /// Remaining difference of the conversion of its model; `None` if nothing had to be converted.
    pub conversion: Option<Conversion>,
    /// Covariance of the written parameters.
    pub covariance: Option<Covariance>,
    /// Properties of the camera that the format cannot hold.
    pub ignored: Vec<Ignored>,
}

/// A covariance in which fx and fy stand by themselves: `f` moves both in their ratio.
pub fn single(covariance: &Covariance, camera: &Camera) -> Covariance {
    let focal = |parameter| camera.interior.get(parameter);
    let Some((fx, fy)) = focal(Parameter::Fx).zip(focal(Parameter::Fy)) else { return covariance.clone() };
    let Some(f) = covariance.parameters.iter().position(|name| name == "f") else { return covariance.clone() };
    let with = |row: &[f64]| -> Vec<f64> {
        let second = row.get(f).map(|value| value * fy / fx);
        row.iter().copied().chain(second).collect()
    };
    let mut matrix: Vec<Vec<f64>> = covariance.matrix.iter().map(|row| with(row)).collect();
    let second = matrix.get(f).map(|row| row.iter().map(|value| value * fy / fx).collect());
    matrix.extend(second);
    let mut parameters = covariance.parameters.clone();
    parameters[f] = "fx".into();
    parameters.push("fy".into());
    Covariance { parameters, matrix }
}

/// Properties of a camera that no foreign format can hold.
pub fn unkept(camera: &Camera, pitch_is_kept: bool) -> Vec<Ignored> {
    let mut notes = Notes::default();
    notes.ignore("pixel_pitch", usize::from(camera.pixel_pitch.is_some() && !pitch_is_kept));
    notes.ignore("free", camera.free.len());
    notes.ignore("sigma", camera.sigma.len());
    notes.ignored
}

/// A covariance as a file of its own.
pub fn covariance_file(camera: &str, model: &str, covariance: &Covariance) -> Result<(String, Vec<u8>)> {
    /// The file.
    #[derive(Serialize)]
    struct File<'a> {
        camera: &'a str,
        model: &'a str,
        #[serde(flatten)]
        covariance: &'a Covariance,
    }
    let json = serde_json::to_vec_pretty(&File { camera, model, covariance });
    let json = json.map_err(|error| Error::Invalid {
        reason: Reason::CannotWriteJson { message: error.to_string() },
        at: Place::default(),
    })?;
    Ok(("camera.covariance.json".to_owned(), json))
}

/// Texts of files with their names.
pub fn texts(files: &Files) -> Result<BTreeMap<&str, String>> {
    let text =
        |(name, bytes): (&'_ String, &Vec<u8>)| super::encoding::text(bytes).map_err(|error| error.in_file(name));
    files.iter().map(|(name, bytes)| Ok((name.as_str(), text((name, bytes))?))).collect()
}
