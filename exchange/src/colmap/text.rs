//! COLMAP's text files.

use crate::reason::ExchangeReason;
use std::fmt::Write;

use super::super::Files;
use super::super::foreign::Outgoing;
use super::super::network::OutgoingNetwork;
use super::super::text::Row;
use super::{Image, Numbered, lens, named};
use sightline::error::{Error, Place, Reason, Result, shortened};
use sightline::project::Camera;

fn rows(text: &str) -> impl Iterator<Item = Row> {
    let lines = text.lines().enumerate().map(|(k, line)| (k + 1, line.trim()));
    lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#')).map(|(k, line)| Row::words(k, line))
}

/// Whether a text has cameras of COLMAP: its first line names a model.
pub fn is_cameras(text: &str) -> bool {
    let model =
        |row: Row| row.fields.get(1).is_some_and(|name| name.bytes().all(|c| c.is_ascii_uppercase() || c == b'_'));
    text.contains("CAMERA_ID") || rows(text).next().is_some_and(model)
}

/// A whole number of any width.
fn whole<T: std::str::FromStr>(row: &Row, index: usize, name: &str) -> Result<T> {
    let field = row.text(index, name)?;
    let wrong = || row.invalid(name, ExchangeReason::NotWhole { name: name.into(), text: shortened(field) }.into());
    field.parse().map_err(|_| wrong())
}

/// `cameras.txt`: CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[].
pub fn cameras(text: &str) -> Result<Vec<Numbered>> {
    let camera = |row: Row| {
        let shape = named(row.text(1, "MODEL")?).map_err(|reason| row.invalid("MODEL", reason))?;
        let size = [row.whole(2, "WIDTH")?, row.whole(3, "HEIGHT")?];
        if size.contains(&0) {
            return Err(row.invalid("WIDTH", ExchangeReason::NoPixels.into()));
        }
        let count = shape.parameters.len();
        if row.fields.len() != 4 + count {
            let (expected, found) =
                (format!("{count} parameters"), format!("{} parameters", row.fields.len().saturating_sub(4)));
            return Err(row.invalid("PARAMS", ExchangeReason::ExpectedHere { expected, found }.into()));
        }
        let values: Result<Vec<f64>> =
            shape.parameters.iter().enumerate().map(|(k, (name, _))| row.number(4 + k, name)).collect();
        let wrong = || {
            let (expected, found) = ("a focal length above 0".into(), shortened(&row.fields[4]));
            row.invalid("PARAMS", ExchangeReason::ExpectedHere { expected, found }.into())
        };
        let lens = lens(shape, &values?).ok_or_else(wrong)?;
        Ok((whole(&row, 0, "CAMERA_ID")?, shape, lens, size))
    };
    rows(text).map(camera).collect()
}

/// `images.txt`: IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME, and in a second line, which may be empty, X, Y, POINT3D_ID.
pub fn images(text: &str) -> Result<Vec<Image>> {
    let mut images = Vec::new();
    let mut lines = text.lines().enumerate();
    while let Some((k, line)) = lines.next() {
        if line.trim().is_empty() || line.trim_start().starts_with('#') {
            continue;
        }
        let row = Row::words(k + 1, line);
        let mut image =
            Image { id: whole(&row, 0, "IMAGE_ID")?, camera: whole(&row, 8, "CAMERA_ID")?, ..Image::default() };
        for (k, name) in ["QW", "QX", "QY", "QZ"].into_iter().enumerate() {
            image.quaternion[k] = row.number(1 + k, name)?;
        }
        for (k, name) in ["TX", "TY", "TZ"].into_iter().enumerate() {
            image.translation[k] = row.number(5 + k, name)?;
        }
        row.text(9, "NAME")?;
        image.name = row.fields[9..].join(" ");
        let Some((k, line)) = lines.next() else {
            return Err(Error::Invalid {
                reason: ExchangeReason::EndsWhere { expected: "X, Y, POINT3D_ID of the keypoints".into() }.into(),
                at: Place::line(k + 2),
            });
        };
        // Lines of megabytes: no row of texts is made of them.
        let mut words = line.split_whitespace();
        while let Some(x) = words.next() {
            let invalid = |name: &str, reason| Error::Invalid { reason, at: Place::line(k + 1).with_field(name) };
            let number = |name: &str, word: Option<&str>| {
                let word = word.unwrap_or_default();
                let wrong = || invalid(name, Reason::NotANumber { name: name.into(), text: shortened(word) });
                super::super::tree::number(word).ok_or_else(wrong)
            };
            let pixel = [number("X", Some(x))?, number("Y", words.next())?];
            let word = words.next().unwrap_or_default();
            let id: i64 = word.parse().map_err(|_| {
                invalid(
                    "POINT3D_ID",
                    ExchangeReason::NotWhole { name: "POINT3D_ID".into(), text: shortened(word) }.into(),
                )
            })?;
            match u64::try_from(id) {
                Ok(id) => image.measured.push((pixel, id)),
                Err(_) => image.free += 1,
            }
        }
        images.push(image);
    }
    Ok(images)
}

/// `points3D.txt`: POINT3D_ID, X, Y, Z and more.
pub fn points(text: &str) -> Result<Vec<(u64, [f64; 3])>> {
    let mut points = Vec::new();
    for (k, line) in text.lines().enumerate() {
        let line = line.trim_start();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        // The rest is colours, an error, and a track that the images have too.
        let fields = line.split_whitespace().take(4).map(str::to_owned).collect();
        let row = Row { line: k + 1, fields };
        points.push((whole(&row, 0, "POINT3D_ID")?, [row.number(1, "X")?, row.number(2, "Y")?, row.number(3, "Z")?]));
    }
    Ok(points)
}

/// A line of `cameras.txt`.
pub fn camera_line(number: usize, camera: &Camera, out: &Outgoing) -> String {
    let values: Vec<String> = out.values.iter().map(|value| format!("{value:?}")).collect();
    format!("{number} {} {} {} {}", out.shape.name, camera.width, camera.height, values.join(" "))
}

/// `cameras.txt`.
pub fn cameras_text(lines: &[String]) -> String {
    let mut text = String::from(
        "# Camera list with one line of data per camera:\n#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n",
    );
    let _ = writeln!(text, "# Number of cameras: {}", lines.len());
    lines.iter().for_each(|line| text = std::mem::take(&mut text) + line + "\n");
    text
}

/// The three files.
pub fn write(network: &OutgoingNetwork) -> Files {
    let lines: Vec<String> =
        network.cameras.iter().enumerate().map(|(k, (camera, out))| camera_line(k + 1, camera, out)).collect();
    let mut images = String::from(
        "# Image list with two lines of data per image:\n#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n#   POINTS2D[] as (X, Y, POINT3D_ID)\n",
    );
    for photo in &network.photos {
        let ([w, x, y, z], [tx, ty, tz]) = (photo.pose.quaternion(), photo.pose.translation());
        let (number, camera, file) = (photo.number, photo.camera + 1, photo.file.replace(['\n', '\r'], " "));
        let _ = writeln!(images, "{number} {w:?} {x:?} {y:?} {z:?} {tx:?} {ty:?} {tz:?} {camera} {file}");
        for (k, ([u, v], point)) in photo.measured.iter().enumerate() {
            let blank = if k == 0 { "" } else { " " };
            let _ = write!(images, "{blank}{u:?} {v:?} {}", network.points[*point].number);
        }
        images.push('\n');
    }
    let mut points = String::from(
        "# 3D point list with one line of data per point:\n#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n",
    );
    for point in &network.points {
        let [x, y, z] = point.xyz;
        let _ = write!(points, "{} {x:?} {y:?} {z:?} 128 128 128 -1", point.number);
        for (photo, place) in &point.seen {
            let _ = write!(points, " {} {place}", network.photos[*photo].number);
        }
        points.push('\n');
    }
    Files::from([
        ("cameras.txt".to_owned(), cameras_text(&lines).into_bytes()),
        ("images.txt".to_owned(), images.into_bytes()),
        ("points3D.txt".to_owned(), points.into_bytes()),
    ])
}
