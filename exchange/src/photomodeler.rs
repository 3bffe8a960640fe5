//! PhotoModeler's text export.
//!
//! Line 1 is a heading, line 2 holds tolerance, iterations and the picture's size in pixels, line 4 the camera: c, xp, yp,
//! W, H, K1-3, P1, P2 in millimetres, principal point from the top left corner, y downwards. Then, for each photo (counted
//! from 0): number and path; X, Y, Z, κ, φ, ω in degrees; their sigmas; a blank line; the camera of that photo and
//! its sigmas. Three blocks follow, each ended by a blank line: control points and all object points
//! (id, X, Y, Z, sigmas; a sigma below or of 0 is a fixed axis), and marks (photo, point, u, v, sigma u, sigma v in pixels). What comes
//! after them (features) is not read.
//!
//! K and P correct the measured point, as ours do. The format W x H over the size in pixels gives the pixel pitch of each
//! axis, which takes up the affinity that PhotoModeler puts on the coordinate before the distortion.

use super::{name_photos_and_points, text};
use crate::reason::ExchangeReason;
use crate::reason::PhotoModelerPart as Part;
use sightline::error::{Error, Lack, Place, Result, Thing};
use sightline::project::{Camera, DatumKind, Interior, Observation, Parameter, Photo, Point, Project, Role, Sigma};

/// Reads an export: cameras (photos with the same interior orientation share one), photos, points, observations.
///
/// # Errors
/// [`Error::Invalid`] with line and field.
pub fn parse(text: &str) -> Result<Project> {
    let mut lines = Lines { lines: text.lines().collect(), next: 0 };
    let heading = lines.take(Part::Heading)?;
    let name = heading.fields.join(" ");
    let name = name.strip_prefix("Bundle Soln").unwrap_or(&name).trim().to_owned();
    let size = lines.take(Part::Size)?;
    let (width, height) = (size.whole(2, "width")?, size.whole(3, "height")?);
    if width == 0 || height == 0 {
        return Err(size.invalid("width", ExchangeReason::NoPixels.into()));
    }
    let _weights = lines.take(Part::Weights)?;
    let standard = interior(&lines.take(Part::Camera)?, 0, [width, height])?;
    let _sigmas = lines.take(Part::CameraSigmas)?;

    let mut project = Project { name, ..Project::default() };
    let mut interiors = Vec::new();
    while lines.peek().is_some_and(|row| row.fields.len() >= 2 && text::number(&row.fields[1]).is_none()) {
        let title = lines.take(Part::Photo)?;
        let path = title.fields[1..].join(" ");
        let station = lines.take(Part::Exterior)?;
        let mut six = [0.0; 6];
        for (value, (index, name)) in
            six.iter_mut().zip(["X", "Y", "Z", "kappa", "phi", "omega"].into_iter().enumerate())
        {
            *value = station.number(index + 1, name)?;
        }
        let _sigmas = lines.take(Part::ExteriorSigmas)?;
        lines.skip_blank();
        let camera = match lines.peek() {
            Some(row) if row.fields.len() >= 11 => {
                let own = interior(&lines.take(Part::PhotoCamera)?, 1, [width, height])?;
                if rounded(&standard, &own) { standard.clone() } else { own }
            }
            _ => standard.clone(),
        };
        if lines.peek().is_some_and(|row| row.fields.len() >= 11 && row.fields[0] == title.fields[0]) {
            let _sigmas = lines.take(Part::PhotoCameraSigmas)?;
        }
        let number = interiors.iter().position(|known| *known == camera).unwrap_or_else(|| {
            interiors.push(camera);
            interiors.len() - 1
        });
        let [x, y, z, kappa, phi, omega] = six;
        project.photos.push(Photo {
            id: title.fields[0].clone(),
            camera: (number + 1).to_string(),
            file: path.rsplit(['/', '\\']).next().unwrap_or_default().to_owned(),
            position: Some([x, y, z]),
            rotation: Some([omega, phi, kappa].map(f64::to_radians)),
            enabled: true,
            ..Photo::default()
        });
    }
    project.cameras = interiors
        .into_iter()
        .enumerate()
        .map(|(number, camera)| Camera { id: (number + 1).to_string(), ..camera })
        .collect();

    let control = points(&lines.block(), Role::Control)?;
    let all = points(&lines.block(), Role::Tie)?;
    let marks = lines.block();
    project.datum.kind = if control.is_empty() { DatumKind::Free } else { DatumKind::Control };
    let known: std::collections::HashSet<String> = control.iter().map(|point| point.id.clone()).collect();
    project.points = control.into();
    project.points.extend(all.into_iter().filter(|point| !known.contains(&point.id)));
    for row in &marks {
        project.observations.push(Observation {
            photo: row.text(0, "photo")?.to_owned(),
            point: row.text(1, "point")?.to_owned(),
            u: row.number(2, "u")?,
            v: row.number(3, "v")?,
            sigma: Sigma::Two([row.number(4, "sigma u")?, row.number(5, "sigma v")?]),
            enabled: true,
            target: None,
        });
    }
    let photos: std::collections::HashSet<&str> = project.photos.iter().map(|photo| photo.id.as_str()).collect();
    if let Some((mark, row)) =
        project.observations.iter().zip(&marks).find(|(mark, _)| !photos.contains(mark.photo.as_str()))
    {
        return Err(Error::Unknown { kind: Thing::Photo, name: mark.photo.clone(), at: Place::line(row.line) });
    }
    name_photos_and_points(&mut project);
    if project.photos.is_empty() { Err(Error::Empty { what: Lack::Photos }) } else { Ok(project) }
}

/// Interior orientation from c, xp, yp, W, H, K1-3, P1, P2, which start at field `first`.
fn interior(row: &text::Row, first: usize, [width, height]: [u32; 2]) -> Result<Camera> {
    const NAMES: [&str; 10] = ["c", "xp", "yp", "W", "H", "K1", "K2", "K3", "P1", "P2"];
    let mut values = [0.0; 10];
    for (index, name) in NAMES.into_iter().enumerate() {
        values[index] = row.number(first + index, name)?;
    }
    let [c, xp, yp, w, h, k1, k2, k3, p1, p2] = values;
    for (index, name) in [(0, "c"), (3, "W"), (4, "H")] {
        row.positive(first + index, name)?;
    }
    let pitch = [w / f64::from(width), h / f64::from(height)];
    let (x0, y0) = (xp - w / 2.0, h / 2.0 - yp);
    let interior = Interior::Brown { c: Some(c), x0, y0, k1, k2, k3, p1, p2, b1: 0.0, b2: 0.0 };
    Ok(Camera { pixel_pitch: Some(pitch), ..Camera::new("", width, height, interior) })
}

/// Whether a photo's camera is the common one: its c, xp and yp are printed with one digit less.
fn rounded(common: &Camera, own: &Camera) -> bool {
    use Parameter as P;
    let difference = |parameter| match (common.interior.get(parameter), own.interior.get(parameter)) {
        (Some(a), Some(b)) => (a - b).abs(),
        _ => f64::INFINITY,
    };
    common.pixel_pitch == own.pixel_pitch
        && [P::C, P::X0, P::Y0].into_iter().all(|parameter| difference(parameter) < 0.000_51)
        && [P::K1, P::K2, P::K3, P::P1, P::P2].into_iter().all(|parameter| difference(parameter) == 0.0)
}

fn points(rows: &[text::Row], role: Role) -> Result<Vec<Point>> {
    let point = |row: &text::Row| {
        let xyz = [row.number(1, "X")?, row.number(2, "Y")?, row.number(3, "Z")?];
        let mut sigma = [None; 3];
        for (axis, name) in ["sX", "sY", "sZ"].into_iter().enumerate() {
            sigma[axis] = Some(row.number(4 + axis, name)?).filter(|sigma| *sigma > 0.0);
        }
        // The sigmas of object points are results, not something given.
        let sigma = (role == Role::Control && sigma.iter().any(Option::is_some)).then_some(sigma);
        Ok(Point { id: row.text(0, "id")?.to_owned(), role, xyz: Some(xyz), sigma, diameter: None, normal: None })
    };
    rows.iter().map(point).collect()
}

/// The export's lines; blank ones separate its blocks.
struct Lines<'a> {
    lines: Vec<&'a str>,
    next: usize,
}

impl Lines<'_> {
    fn row(&self, index: usize) -> Option<text::Row> {
        self.lines.get(index).map(|line| text::Row::words(index + 1, line))
    }

    fn peek(&self) -> Option<text::Row> {
        self.row(self.next)
    }

    fn take(&mut self, part: Part) -> Result<text::Row> {
        let row = self.peek().filter(|row| !row.fields.is_empty()).ok_or_else(|| Error::Invalid {
            reason: ExchangeReason::PhotoModelerCut { part }.into(),
            at: Place::line(self.next + 1),
        })?;
        self.next += 1;
        Ok(row)
    }

    fn skip_blank(&mut self) {
        while self.peek().is_some_and(|row| row.fields.is_empty()) {
            self.next += 1;
        }
    }

    /// Rows up to the next blank line. One blank line stands before each block; a block may be empty.
    fn block(&mut self) -> Vec<text::Row> {
        if self.peek().is_some_and(|row| row.fields.is_empty()) {
            self.next += 1;
        }
        let mut rows = Vec::new();
        while let Some(row) = self.peek().filter(|row| !row.fields.is_empty()) {
            rows.push(row);
            self.next += 1;
        }
        rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    const EXPORT: &str = "Bundle Soln Test sheet
 0.000500 20 2000 1000
 1 1 1 1 1 1 1 1 1
 10.0 5.5 2.4 10.0 5.0 0.001 0 0 0.0001 -0.0002
 0 0.007 0.005 0.5 0.5 0.001 0.0001 0.0001 0.001 0.001
   0 a/b/P 1.JPG
   0 1 2 3 90 0 -180
   0 .1 .1 .1 .1 .1 .1

   0 10.0 5.5 2.4 10.0 5.0 0.001 0 0 0.0001 -0.0002
   0 0 0.007 0.005 0.5 0.5 0.001 0.0001 0.0001 0.001 0.001

   7 0 0 0 -1 -1 0.02

   7 0 0 0 -1 -1 0.02
   8 1 2 3 .1 .1 .1

   0 7 10 20 .1 .2
   0 8 30 40 1 1

   1 1 7

   0 1
";

    #[test]
    fn conventions_are_converted() {
        let project = parse(EXPORT).unwrap();
        assert_eq!(project.name, "Test sheet");
        assert_eq!((project.cameras.len(), project.photos.len(), project.points.len()), (1, 1, 2));
        let camera = &project.cameras[0];
        assert_eq!((camera.width, camera.pixel_pitch), (2000, Some([0.005, 0.005])));
        let Interior::Brown { c, x0, y0, p2, .. } = camera.interior else { panic!("a brown model") };
        assert_eq!((c, x0, p2), (Some(10.0), 0.5, -0.0002));
        assert!((y0 - 0.1).abs() < 1e-12);
        assert_eq!(project.photos[0].file, "P 1.JPG");
        assert_eq!(project.photos[0].rotation, Some([(-180f64).to_radians(), 0.0, 90f64.to_radians()]));
        assert_eq!(project.points[0].role, Role::Control);
        assert_eq!(project.points[0].sigma, Some([None, None, Some(0.02)]));
        assert_eq!((project.points[1].role, project.points[1].sigma), (Role::Tie, None));
        assert_eq!(project.observations[0].sigma, Sigma::Two([0.1, 0.2]));
    }

    #[test]
    fn what_is_cut_or_wrong_is_named() {
        for lines in 1..5 {
            let cut = EXPORT.lines().take(lines).collect::<Vec<_>>().join("\n");
            assert_eq!(parse(&cut).unwrap_err().place().line, Some(lines + 1));
        }
        let error = parse(&EXPORT.replace("   8 1 2 3", "   8 1 zwei 3")).unwrap_err();
        assert_eq!(error.place(), Place::line(16).with_field("Y"));
        assert_eq!(parse(&EXPORT.replace("   0 8 30", "   4 8 30")).unwrap_err().place().line, Some(19));
        assert!(parse("PK\u{3}\u{4}").is_err());
    }
}
