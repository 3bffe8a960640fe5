//! Import and export of single cameras; the format is recognised by content.

use crate::reason::ExchangeReason;
use serde::Serialize;

use super::conversion::Conversion;
use super::foreign::{self, Assumed, CameraOptions, ExportedCamera, ForeignCamera, Ignored, ImportedCamera, Notes};
use super::tree::{self, Node};
use super::{
    Files, Format, agisoft_lens, bal, bundler, colmap, dbat, encoding, kalibr, meshroom, metashape, micmac, mrcal,
    opencv, ros,
};
use sightline::equipment::{Calibration, KnownCamera};
use sightline::error::{Error, Lack, Place, Result, Thing};
use sightline::project::{Camera, Origin};

/// Formats of cameras.
pub const FORMATS: [Format; 9] = [
    Format { name: "opencv", import: true, export: true },
    Format { name: "ros", import: true, export: true },
    Format { name: "kalibr", import: true, export: true },
    Format { name: "mrcal", import: true, export: true },
    Format { name: "colmap", import: true, export: true },
    Format { name: "metashape", import: true, export: false },
    Format { name: "meshroom", import: true, export: false },
    Format { name: "agisoft-lens", import: true, export: true },
    Format { name: "micmac", import: true, export: true },
];

/// Cameras that were read.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ImportedCameras {
    /// Format.
    pub format: &'static str,
    /// The cameras.
    pub cameras: Vec<ImportedCamera>,
    /// Assumptions.
    pub assumed: Vec<Assumed>,
    /// Contents of the files that are not imported.
    pub ignored: Vec<Ignored>,
}

impl ImportedCameras {
    /// Conversions of the cameras.
    pub fn conversions(&self) -> impl Iterator<Item = &Conversion> {
        self.cameras.iter().filter_map(|camera| camera.conversion.as_ref())
    }
}

/// An imported camera as equipment: identified by its name and sensor grid, with the standard errors of its file.
pub fn known(imported: &ImportedCamera, origin: &Origin, date: &str) -> KnownCamera {
    let camera = &imported.camera;
    let named = |name: &str| camera.interior.parameters().iter().copied().find(|parameter| parameter.name() == name);
    let covariance = imported.covariance.as_ref();
    let sigma = covariance.into_iter().flat_map(|covariance| {
        let diagonal = covariance.matrix.iter().enumerate().map(|(k, row)| row.get(k).copied().unwrap_or(0.0).sqrt());
        covariance.parameters.iter().zip(diagonal).filter_map(|(name, sigma)| Some((named(name)?, sigma)))
    });
    let conversions = imported.conversion.iter().cloned().collect();
    // Without a camera name in the file the file name is used: two such files are two cameras, not two calibrations of one.
    let id = match &origin.files[..] {
        [file] if camera.id == "camera" => {
            let file = file.rsplit(['/', '\\']).next().unwrap_or_default();
            file.rsplit_once('.').map_or(file, |(stem, _)| stem).to_owned()
        }
        _ => camera.id.clone(),
    };
    KnownCamera {
        id,
        make: None,
        model: None,
        focal_length_mm: None,
        width: camera.width,
        height: camera.height,
        calibrations: vec![Calibration {
            date: date.to_owned(),
            pixel_pitch: camera.pixel_pitch,
            interior: camera.interior,
            sigma: sigma.filter(|(_, sigma)| *sigma > 0.0 && sigma.is_finite()).collect(),
            remark: String::new(),
            origin: Some(Box::new(Origin { conversions, ..origin.clone() })),
        }],
    }
}

fn unknown(format: &str, wanted: fn(&Format) -> bool) -> Error {
    let known: Vec<&str> = FORMATS.iter().filter(|known| wanted(known)).map(|known| known.name).collect();
    let at = Place::field(format!("format: one of {}", known.join(", ")));
    Error::Unknown { kind: Thing::Format, name: format.into(), at }
}

/// The parsed content of a text file.
enum Content {
    Tree(serde_json::Value),
    Xml(dbat::element::Element),
    Text(String),
}

fn content(format: &str, bytes: &[u8]) -> Result<Content> {
    let text = encoding::text(bytes)?;
    Ok(match format {
        "mrcal" => Content::Text(text),
        "agisoft-lens" | "micmac" => Content::Xml(dbat::element::parse(&text)?),
        "meshroom" => Content::Tree(tree::json(&text)?),
        "opencv" => Content::Tree(tree::parse(&text)?),
        _ => Content::Tree(tree::yaml(&text)?),
    })
}

/// The format of files with cameras, by their content.
pub fn recognised(files: &Files) -> Option<&'static str> {
    if colmap::recognises(files) {
        return Some("colmap");
    }
    let of = |bytes: &Vec<u8>| -> Option<&'static str> {
        let text = encoding::text(bytes).ok()?;
        let start = text.trim_start();
        if bundler::recognises(&text) || bal::recognises(&text) {
            return None;
        }
        if start.starts_with('<') {
            let root = dbat::element::parse(&text).ok()?;
            if agisoft_lens::recognises(&root) {
                return Some("agisoft-lens");
            }
            if micmac::recognises(&root) {
                return Some("micmac");
            }
            if metashape::recognises(&root) {
                return Some("metashape");
            }
        }
        // The Python dictionary of mrcal could also be parsed as YAML, so it is tested first.
        if mrcal::recognises(&text) {
            return Some("mrcal");
        }
        let tree = tree::parse(&text).ok()?;
        let root = Node::root(&tree);
        if meshroom::recognises(&root) {
            return Some("meshroom");
        }
        if kalibr::recognises(&root) {
            return Some("kalibr");
        }
        if ros::recognises(&root) {
            return Some("ros");
        }
        opencv::recognises(&root).then_some("opencv")
    };
    files.values().find_map(of)
}

/// Reads cameras. A model that the engine does not have is converted over a region: the given one, else that of the file, else the whole
/// picture.
///
/// # Errors
/// [`Error::Unknown`] for a format that is not read, [`Error::Empty`] without files, [`Error::Invalid`] with file and line or element,
/// [`ExchangeReason::NoSuchCameraModel`], [`ExchangeReason::ConversionTooLarge`].
pub fn import(format: &str, files: &Files, options: &CameraOptions) -> Result<ImportedCameras> {
    if files.is_empty() {
        return Err(Error::Empty { what: Lack::Files });
    }
    let format = match format {
        "auto" => recognised(files)
            .ok_or(Error::Invalid { reason: ExchangeReason::FormatUnrecognised.into(), at: Place::field("format") })?,
        named => FORMATS
            .iter()
            .find(|known| known.import && known.name == named)
            .map(|known| known.name)
            .ok_or_else(|| unknown(named, |known| known.import))?,
    };
    let mut notes = Notes::default();
    let mut cameras = Vec::new();
    let settle = |camera: &ForeignCamera| foreign::settled(camera, options.region.as_deref(), options.convert);
    match format {
        "colmap" => {
            for camera in colmap::read_cameras(files, &mut notes)? {
                cameras.push(settle(&camera)?);
            }
        }
        "metashape" => {
            let network = metashape::read(files)?;
            notes = network.notes;
            notes.ignore("photos", network.photos.len());
            notes.ignore("markers", network.points.len());
            for camera in &network.cameras {
                cameras.push(settle(camera)?);
            }
        }
        _ => {
            for (name, bytes) in files {
                let stem = name.rsplit(['/', '\\']).next().unwrap_or_default();
                let stem = stem.rsplit_once('.').map_or(stem, |(stem, _)| stem);
                let id = if stem.is_empty() { "camera" } else { stem };
                let mut read = || -> Result<Vec<ImportedCamera>> {
                    let found = match content(format, bytes)? {
                        Content::Text(text) => mrcal::read(&text, id, &mut notes)?,
                        Content::Xml(root) if format == "micmac" => micmac::read(&root, id, &mut notes)?,
                        Content::Xml(root) if agisoft_lens::recognises(&root) => {
                            agisoft_lens::read(&root, id, &mut notes)?
                        }
                        Content::Xml(root) => {
                            return Err(agisoft_lens::wrong(&root.name, "a calibration with its projection", ""));
                        }
                        Content::Tree(tree) => {
                            let root = Node::root(&tree);
                            match format {
                                "ros" => ros::read(&root, &mut notes)?,
                                "kalibr" => kalibr::read(&root, &mut notes)?,
                                "meshroom" => meshroom::cameras(&root, &mut notes)?,
                                _ => opencv::read(&root, &mut notes)?,
                            }
                        }
                    };
                    found.iter().map(settle).collect()
                };
                cameras.extend(read().map_err(|error| error.in_file(name))?);
            }
        }
    }
    // Several cameras without names get numbers.
    let mut taken = std::collections::HashSet::new();
    for camera in &mut cameras {
        let name = camera.camera.id.clone();
        let mut number = 2;
        while !taken.insert(camera.camera.id.clone()) {
            camera.camera.id = format!("{name} {number}");
            number += 1;
        }
    }
    Ok(ImportedCameras { format, cameras, assumed: notes.assumed, ignored: notes.ignored })
}

/// Writes a camera.
///
/// # Errors
/// [`Error::Unknown`] for a format that is not written, and as [`foreign::outgoing`].
pub fn export(format: &str, camera: &Camera, options: &CameraOptions) -> Result<ExportedCamera> {
    sightline::project::Project { cameras: vec![camera.clone()], ..sightline::project::Project::default() }
        .validate()?;
    match format {
        "opencv" => opencv::write(camera, options),
        "ros" => ros::write(camera, options),
        "kalibr" => kalibr::write(camera, options),
        "mrcal" => mrcal::write(camera, None, options),
        "colmap" => colmap::write_camera(camera, options),
        "agisoft-lens" => agisoft_lens::write(camera, options),
        "micmac" => micmac::write(camera, options),
        _ => Err(unknown(format, |known| known.export)),
    }
}
