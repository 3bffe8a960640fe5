//! Photos of printed sheets as cameras take them: the PDF as poppler draws it at a printer's resolution lies on a table, is seen in
//! perspective, blurred, sharpened and has noise. It shares no code with the engine's own rendering.

use std::process::Command;

use nalgebra::{Matrix2, Matrix3, SymmetricEigen, Vector2, Vector3};
use sightline::detection::Target;
use sightline::image::{Grey, GreyView, Samples, SamplesView};
use sightline::noise::Noise;
use sightline_report::sheets::Sheets;

use super::coded_patch::blurred;
use super::painter::Uniform;

/// The PDF's pages as poppler draws them at a resolution; `None` if poppler is not there.
pub fn drawn(pdf: &[u8], dpi: u32, pages: usize, name: &str) -> Option<Vec<Grey>> {
    let folder = std::env::temp_dir().join(format!("sightline-sheets-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("sheets.pdf");
    std::fs::write(&file, pdf).expect("written");
    let ran = Command::new("pdftoppm")
        .args(["-gray", "-r", &dpi.to_string()])
        .args([file.as_os_str(), folder.join("page").as_os_str()])
        .status();
    let read = |k: usize| {
        let digits = pages.to_string().len();
        let bytes = std::fs::read(folder.join(format!("page-{k:0digits$}.pgm"))).expect("a page");
        pgm(&bytes)
    };
    let greys = ran.ok().map(|status| {
        assert!(status.success());
        (1..=pages).map(read).collect()
    });
    std::fs::remove_dir_all(&folder).expect("removed");
    greys
}

fn pgm(bytes: &[u8]) -> Grey {
    let mut fields = Vec::new();
    let mut at = 0;
    while fields.len() < 4 {
        let end = at + bytes[at..].iter().position(u8::is_ascii_whitespace).expect("a field");
        fields.push(String::from_utf8_lossy(&bytes[at..end]).into_owned());
        at = end + 1;
    }
    let [width, height] = [1, 2].map(|k: usize| fields[k].parse().expect("a number"));
    Grey { width, height, samples: Samples::U8(bytes[at..at + width * height].to_vec()) }
}

/// A printed sheet.
pub struct Print {
    width: usize,
    height: usize,
    samples: Vec<u8>,
    dots: Vec<Dot>,
}

/// A target on it, in pixels of the print.
struct Dot {
    number: Option<u32>,
    at: [f64; 2],
    radius: f64,
}

impl Print {
    /// A page of sheets at a resolution. A dot's place is where its ink lies: the mean over a square that the ring leaves clear.
    pub fn new(sheets: &Sheets, page: usize, grey: Grey, dpi: u32) -> Self {
        let pixel = 25.4 / f64::from(dpi);
        let Samples::U8(samples) = grey.samples else { unreachable!("eight bits are drawn") };
        let (width, height) = (grey.width, grey.height);
        let radius = sheets.diameter / 2.0 / pixel;
        let dot = |at: [f64; 2]| {
            let half = 1.35 * radius;
            let [x, y] = at.map(|x| ((x - half) as usize, (x + half) as usize + 1));
            let ground = f64::from(samples[y.0 * width + x.0]);
            let mut sums = [0.0; 3];
            for row in y.0..y.1 {
                for column in x.0..x.1 {
                    let ink = f64::from(samples[row * width + column]) - ground;
                    let terms = [1.0, column as f64 + 0.5, row as f64 + 0.5];
                    sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += ink * term);
                }
            }
            [sums[1] / sums[0], sums[2] / sums[0]]
        };
        let here = sheets.targets.iter().filter(|t| t.sheet == page + 1);
        let dots = here.map(|t| Dot { number: t.number, at: dot(t.at.map(|x| x / pixel)), radius }).collect();
        Self { width, height, samples, dots }
    }

    /// Share of white at a place, straight lines between pixels' middles; none beside the sheet.
    fn at(&self, x: f64, y: f64) -> Option<f64> {
        let (left, top) = (x - 0.5, y - 0.5);
        let inside = left >= 0.0 && top >= 0.0 && left < (self.width - 1) as f64 && top < (self.height - 1) as f64;
        if !inside {
            return None;
        }
        let (column, row) = (left as usize, top as usize);
        let (right, down) = (left - column as f64, top - row as f64);
        let of = |k: usize| f64::from(self.samples[k]);
        let k = row * self.width + column;
        let upper = of(k) + right * (of(k + 1) - of(k));
        let lower = of(k + self.width) + right * (of(k + self.width + 1) - of(k + self.width));
        Some((upper + down * (lower - upper)) / 255.0)
    }
}

/// How it is photographed.
#[derive(Clone, Copy, Debug)]
pub struct Taken {
    /// Angle between the sheet's normal and the camera's axis; direction of the slope on the sheet; turn of the camera.
    pub tilt: f64,
    pub slope: f64,
    pub roll: f64,
    /// Smaller axis of a dot in the sheet's middle, pixels.
    pub minor: f64,
    /// Distance over the sheet's diagonal: a lens from wide to long.
    pub distance: f64,
    /// Point spread, and an unsharp mask's amount and radius.
    pub blur: f64,
    pub sharpening: f64,
    pub sharp_radius: f64,
    /// Grey levels of ink and paper, the light's slope over the picture, and the noise that is in it when all is done.
    pub levels: [f64; 2],
    pub light: [f64; 2],
    pub noise: f64,
    pub seed: u64,
}

impl Taken {
    /// A photo at random: tilts to 60°, dots from 7 to 24 px; half of the photos are sharpened.
    pub fn at_random(random: &mut Uniform) -> Self {
        let dark = random.within(12.0, 50.0);
        Self {
            tilt: random.within(0.0, 60f64.to_radians()),
            slope: random.within(0.0, std::f64::consts::TAU),
            roll: random.within(0.0, std::f64::consts::TAU),
            minor: 7.0 * (random.next() * (24f64 / 7.0).ln()).exp(),
            distance: random.within(1.0, 4.0),
            blur: random.within(0.4, 1.3),
            sharpening: if random.next() < 0.5 { random.within(0.0, 1.5) } else { 0.0 },
            sharp_radius: random.within(0.6, 1.5),
            levels: [dark, dark + random.within(80.0, 190.0)],
            light: [random.within(-0.15, 0.15), random.within(-0.15, 0.15)],
            noise: random.within(0.5, 2.5),
            seed: (random.next() * 1e15) as u64,
        }
    }
}

/// A target as it has to be found.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    pub number: Option<u32>,
    /// Centre of its ellipse, semi-axes, direction of the minor one, away from the camera.
    pub centre: [f64; 2],
    pub axes: [f64; 2],
    pub across: [f64; 2],
    /// Angle between its ray and the sheet's normal.
    pub incidence: f64,
}

impl Seen {
    /// The target that was found there.
    pub fn found<'a>(&self, targets: &'a [Target]) -> Option<&'a Target> {
        let distance = |t: &&Target| (t.u - self.centre[0]).hypot(t.v - self.centre[1]);
        let alike = |t: &&Target| t.major > 1.2 * self.axes[0] && t.major < 2.8 * self.axes[0];
        let near = targets.iter().filter(alike).filter(|t| distance(t) < 0.5 * self.axes[1]);
        near.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// How many others were found in it.
    pub fn others(&self, targets: &[Target]) -> usize {
        let inside = |t: &&Target| (t.u - self.centre[0]).hypot(t.v - self.centre[1]) < self.axes[1];
        let all = targets.iter().filter(inside).count();
        all.saturating_sub(usize::from(self.found(targets).is_some()))
    }
}

/// A photo of a print, and what is true of it.
pub struct Shot {
    width: usize,
    height: usize,
    samples: Vec<u8>,
    pub seen: Vec<Seen>,
}

/// Sub-pixels a pixel.
const FINE: usize = 4;
/// Table around the sheet, pixels, and its share of white.
const MARGIN: f64 = 12.0;
const TABLE: f64 = 0.4;

impl Shot {
    pub fn view(&self) -> GreyView<'_> {
        GreyView::new(self.width, self.height, SamplesView::U8(&self.samples)).expect("a picture")
    }

    /// Photographs a print.
    pub fn new(print: &Print, taken: &Taken) -> Self {
        let (photo_from_print, distance, [width, height]) = geometry(print, taken);
        let (wide, high) = (FINE * width, FINE * height);
        let back = photo_from_print.try_inverse().expect("a view from the front");
        let mut fine = vec![0f32; wide * high];
        for (k, level) in fine.iter_mut().enumerate() {
            let [u, v] = [k % wide, k / wide].map(|i| (i as f64 + 0.5) / FINE as f64);
            let place = back * Vector3::new(u, v, 1.0);
            *level = print.at(place.x / place.z, place.y / place.z).unwrap_or(TABLE) as f32;
        }
        let fine = blurred(&fine, wide, taken.blur * FINE as f64);
        let share = |k: usize| {
            let (x, y) = (k % width * FINE, k / width * FINE);
            let block = (0..FINE).flat_map(|j| (0..FINE).map(move |i| (y + j) * wide + x + i));
            block.map(|k| fine[k]).sum::<f32>() / (FINE * FINE) as f32
        };
        let mut noise = Noise::new(taken.seed, 0);
        let grain = taken.noise / (1.0 + taken.sharpening);
        let [dark, bright] = taken.levels;
        let side = width.max(height) as f64;
        let light: Vec<f32> = (0..width * height)
            .map(|k| {
                let [x, y] = [k % width, k / width].map(|i| i as f64 / side - 0.5);
                let lit = 1.0 + taken.light[0] * x + taken.light[1] * y;
                ((dark + (bright - dark) * f64::from(share(k))) * lit + grain * noise.normal()) as f32
            })
            .collect();
        let soft = blurred(&light, width, taken.sharp_radius);
        let sharpened = |(light, soft): (&f32, &f32)| light + taken.sharpening as f32 * (light - soft);
        let samples = light.iter().zip(&soft).map(|both| sharpened(both).round().clamp(0.0, 255.0) as u8).collect();
        let seen = print.dots.iter().map(|dot| seen(dot, &photo_from_print, print, taken, distance)).collect();
        Self { width, height, samples, seen }
    }
}

/// Pixels of the photo from those of the print as a homography, the distance in pixels of the print, and the photo's size.
fn geometry(print: &Print, taken: &Taken) -> (Matrix3<f64>, f64, [usize; 2]) {
    let [w, h] = [print.width as f64, print.height as f64];
    let distance = taken.distance * w.hypot(h);
    let radius = print.dots.first().expect("a target").radius;
    let scale = taken.minor / (2.0 * radius) / taken.tilt.cos();
    let (st, ct) = taken.tilt.sin_cos();
    let turn = |angle: f64| {
        let (s, c) = angle.sin_cos();
        Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
    };
    let middle = Matrix3::new(1.0, 0.0, -w / 2.0, 0.0, 1.0, -h / 2.0, 0.0, 0.0, 1.0);
    // (p, q) on the sheet, q along the slope: (p, q cos t) over 1 + q sin t / distance
    let tilted = Matrix3::new(scale, 0.0, 0.0, 0.0, scale * ct, 0.0, 0.0, st / distance, 1.0);
    let view = turn(taken.roll) * tilted * turn(taken.slope) * middle;
    let corners = [[0.0, 0.0], [w, 0.0], [0.0, h], [w, h]].map(|corner| image(&view, corner));
    let range = |k: usize| {
        let sides = corners.iter().map(|corner| corner[k]);
        (sides.clone().fold(f64::INFINITY, f64::min), sides.fold(f64::NEG_INFINITY, f64::max))
    };
    let [(left, right), (top, bottom)] = [range(0), range(1)];
    let size = [right - left, bottom - top].map(|side| (side + 2.0 * MARGIN).ceil() as usize);
    let moved = Matrix3::new(1.0, 0.0, MARGIN - left, 0.0, 1.0, MARGIN - top, 0.0, 0.0, 1.0);
    (moved * view, distance, size)
}

fn image(view: &Matrix3<f64>, [x, y]: [f64; 2]) -> [f64; 2] {
    let place = view * Vector3::new(x, y, 1.0);
    [place.x / place.z, place.y / place.z]
}

/// The ellipse of a circle: its conic C becomes H⁻' C H⁻¹, centre and axes follow from that.
fn seen(dot: &Dot, view: &Matrix3<f64>, print: &Print, taken: &Taken, distance: f64) -> Seen {
    let ([x, y], r) = (dot.at, dot.radius);
    let circle = Matrix3::new(1.0, 0.0, -x, 0.0, 1.0, -y, -x, -y, x * x + y * y - r * r);
    let back = view.try_inverse().expect("a view from the front");
    let conic = back.transpose() * circle * back;
    let shape = Matrix2::new(conic[(0, 0)], conic[(0, 1)], conic[(0, 1)], conic[(1, 1)]);
    let pull = Vector2::new(conic[(0, 2)], conic[(1, 2)]);
    let centre = -shape.try_inverse().expect("an ellipse") * pull;
    let size = -(conic[(2, 2)] + pull.dot(&centre));
    let eigen = SymmetricEigen::new(shape / size);
    let (minor, major) = if eigen.eigenvalues[0] > eigen.eigenvalues[1] { (0, 1) } else { (1, 0) };
    // the sheet's own frame: along the slope it goes away from the camera
    let (s, c) = taken.slope.sin_cos();
    let [near, far] = [-1.0, 1.0].map(|side| Vector2::from(image(view, [x + side * s, y + side * c])));
    let axis = eigen.eigenvectors.column(minor);
    let across = axis * axis.dot(&(far - near)).signum();
    let [px, py] = [x - print.width as f64 / 2.0, y - print.height as f64 / 2.0];
    let (p, q) = (c * px - s * py, s * px + c * py);
    let (st, ct) = taken.tilt.sin_cos();
    let ray = Vector3::new(p, q * ct, distance + q * st).normalize();
    let normal = Vector3::new(0.0, -st, ct);
    Seen {
        number: dot.number,
        centre: centre.into(),
        axes: [major, minor].map(|k| eigen.eigenvalues[k].sqrt().recip()),
        across: [across[0], across[1]],
        incidence: ray.dot(&normal).abs().min(1.0).acos(),
    }
}
