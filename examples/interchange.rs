//! Cameras and networks of other programs, natively, for comparisons with these programs (`tests/peers/interchange.py`). Every answer is JSON.
//!
//! ```text
//! interchange read FORMAT FILE...            cameras of files; FORMAT may be auto
//! interchange pixels CAMERA POINTS           pixels of points (x right, y down, z forwards) in a camera of the document
//! interchange write FORMAT CAMERA FOLDER     a camera as files
//! interchange import FORMAT FILE...          a network as a document
//! interchange export FORMAT PROJECT FOLDER   a document as files
//! interchange project PROJECT                pixels of all points in all photos
//! interchange uncertainty PROJECT OPTIONS    projection uncertainty of an adjustment of the project
//! interchange distances PROJECT OPTIONS      the same by distance
//! ```

use std::error::Error;
use std::path::Path;

use nalgebra::Vector3;
use sightline::adjust::adjust;
use sightline::adjustment::AdjustOptions;
use sightline::calibration::{DistanceOptions, UncertaintyOptions, projection_uncertainty, uncertainty_over_distance};
use sightline::camera::pixel_from_camera_point;
use sightline::project::{Camera, Project};
use sightline::rotation::object_to_camera;
use sightline_exchange::foreign::CameraOptions;
use sightline_exchange::{self as exchange, Choices, Files, cameras};

type Outcome<T = ()> = Result<T, Box<dyn Error>>;

fn read(paths: &[String]) -> Outcome<Files> {
    let name = |path: &String| Path::new(path).file_name().map(|name| name.to_string_lossy().into_owned());
    paths.iter().map(|path| Ok((name(path).unwrap_or_default(), std::fs::read(path)?))).collect()
}

fn save(files: &Files, folder: &str) -> Outcome {
    std::fs::create_dir_all(folder)?;
    files.iter().try_for_each(|(name, bytes)| Ok(std::fs::write(Path::new(folder).join(name), bytes)?))
}

fn json<T: serde::de::DeserializeOwned>(path: &str) -> Outcome<T> {
    Ok(serde_json::from_slice(&std::fs::read(path)?)?)
}

fn main() -> Outcome {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let answer = match words[..] {
        ["read", format, _, ..] => {
            serde_json::to_value(cameras::import(format, &read(&arguments[2..])?, &CameraOptions::default())?)?
        }
        ["pixels", camera, points] => {
            let (camera, points) = (json::<Camera>(camera)?, json::<Vec<[f64; 3]>>(points)?);
            let pixel = |[x, y, z]: &[f64; 3]| pixel_from_camera_point(&camera, Vector3::new(*x, -y, -z));
            serde_json::to_value(points.iter().map(pixel).collect::<Vec<_>>())?
        }
        ["write", format, camera, folder] => {
            let written = cameras::export(format, &json::<Camera>(camera)?, &CameraOptions::default())?;
            save(&written.files, folder)?;
            serde_json::to_value(&written.conversion)?
        }
        ["import", format, _, ..] => {
            let read = read(&arguments[2..])?;
            serde_json::to_value(exchange::import_files(format, &read, &Choices::default())?)?
        }
        ["export", format, project, folder] => {
            save(&exchange::export(format, &json::<Project>(project)?, None)?, folder)?;
            serde_json::Value::Null
        }
        ["uncertainty", project, options] => {
            let (project, options) = (json::<Project>(project)?, json::<UncertaintyOptions>(options)?);
            let adjustment = adjust(&project, &AdjustOptions::default(), &mut |_| true)?;
            let found = projection_uncertainty(&project, &adjustment, &options)?;
            serde_json::json!({ "sigma0": adjustment.sigma0, "uncertainty": found })
        }
        ["distances", project, options] => {
            let (project, options) = (json::<Project>(project)?, json::<DistanceOptions>(options)?);
            let adjustment = adjust(&project, &AdjustOptions::default(), &mut |_| true)?;
            let found = uncertainty_over_distance(&project, &adjustment, &options)?;
            serde_json::json!({ "sigma0": adjustment.sigma0, "uncertainty": found })
        }
        ["project", project] => serde_json::to_value(projected(&json::<Project>(project)?))?,
        _ => return Err("see the head of examples/interchange.rs".into()),
    };
    println!("{answer}");
    Ok(())
}

/// Photo, point and pixel of everything that has an image.
fn projected(project: &Project) -> Vec<(String, String, [f64; 2])> {
    let mut all = Vec::new();
    for photo in &project.photos {
        let camera = project.cameras.iter().find(|camera| camera.id == photo.camera);
        let (Some(camera), Some(position), Some(rotation)) = (camera, photo.position, photo.rotation) else { continue };
        for point in &project.points {
            let Some(xyz) = point.xyz else { continue };
            let p = object_to_camera(rotation) * (Vector3::from(xyz) - Vector3::from(position));
            let pixel = pixel_from_camera_point(camera, p);
            all.extend(pixel.map(|pixel| (photo.id.clone(), point.id.clone(), pixel)));
        }
    }
    all
}
