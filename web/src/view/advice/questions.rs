//! Plausibility questions about the input, shared by orientation and adjustment.

use sightline::adjustment::{
    CameraDoubt, Exchange, ImplausibleCamera, MirroredControl, OneStation, UndecidedAxes, UnitOf, UnitRatio,
};

use super::{Item, Step, Target};
use crate::format;
use crate::i18n::{name_list, text};
use crate::store::axes_here;

fn item(title: String, body: String, evidence: String, target: Target) -> Item {
    Item { warning: true, title, body, evidence, target }
}

pub fn exchange_name(exchange: Exchange) -> String {
    let [x, y, z] = [0, 1, 2].map(|axis| axes_here().letter(axis));
    match exchange {
        Exchange::Xy => text::exchanging(x, y),
        Exchange::Xz => text::exchanging(x, z),
        Exchange::Yz => text::exchanging(y, z),
        Exchange::X => text::negating(x),
        Exchange::Y => text::negating(y),
        Exchange::Z => text::negating(z),
    }
}

pub fn mirrored(found: &MirroredControl) -> Item {
    let others: Vec<String> = found.alternatives.iter().map(|e| exchange_name(*e)).collect();
    let body = match others.is_empty() {
        true => text::mirrored_body().to_owned(),
        false => text::mirrored_or_body(others.join(", ")),
    };
    let [given, exchanged] = [found.rms_given, found.rms_exchanged].map(format::compact);
    let all = std::iter::once(found.exchange).chain(found.alternatives.iter().copied()).collect();
    let title = text::mirrored(exchange_name(found.exchange), &exchanged, &given);
    item(title, body, format!("{given} → {exchanged}"), Target::Exchange(all))
}

pub fn undecided(found: &UndecidedAxes) -> Item {
    let normal = found.normal.map(|x| format::fixed(x, 2)).join(", ");
    item(
        text::undecided_axes().to_owned(),
        text::undecided_axes_body(&normal),
        text::n_points(found.points),
        Target::Step(Step::Control),
    )
}

pub fn unit(found: &UnitRatio) -> Item {
    let bars: Vec<String> = found.distances.iter().map(|(a, b)| format!("{a} – {b}")).collect();
    let bars = name_list(bars);
    let (title, step) = match (found.of, &found.camera) {
        (UnitOf::Distance, _) if !bars.is_empty() => (text::unit_of_distance(bars), Step::Control),
        (UnitOf::Camera, Some(camera)) => (text::unit_of_camera(camera), Step::Photos),
        (UnitOf::Control, _) if !bars.is_empty() => (text::unit_of_control().to_owned(), Step::Control),
        _ => (text::unit_of_diameters().to_owned(), Step::Control),
    };
    let (ratio, nearest) = (format::factor(found.ratio), format::factor(found.nearest));
    item(title, text::unit_body(&ratio, &nearest), format!("{ratio} ≈ {nearest}"), Target::Step(step))
}

pub fn station(found: &OneStation) -> Item {
    let photos = name_list(&found.photos);
    let target = found.photos.first().map_or(Target::None, |photo| Target::Photo(photo.clone()));
    let count = text::n_photos(found.photos.len());
    match found.all {
        true => item(text::one_station_all().to_owned(), text::one_station_all_body().to_owned(), count, target),
        false => item(text::one_station(photos), text::one_station_body().to_owned(), count, target),
    }
}

pub fn camera(found: &ImplausibleCamera) -> Item {
    let camera = &found.camera;
    let photos = || Target::Step(Step::Photos);
    match &found.doubt {
        CameraDoubt::FieldOfView { angle, value, pixels } => item(
            text::field_of_view(camera, format::compact(*value)),
            if *pixels { text::field_of_view_pixels().to_owned() } else { text::field_of_view_body().to_owned() },
            format!("{}°", format::fixed(angle.to_degrees(), 1)),
            photos(),
        ),
        CameraDoubt::ImageSize { photos: names, size: [width, height], measured: [u, v] } => item(
            text::image_size(camera, name_list(names)),
            text::image_size_body(format!("{width} × {height}")),
            format!("{} × {} px", format::fixed(*u, 0), format::fixed(*v, 0)),
            photos(),
        ),
        CameraDoubt::Resized { photo, factor } => item(
            text::photo_resized(photo, camera),
            text::photo_reframed_body().to_owned(),
            format!("× {}", format::fixed(*factor, 3)),
            Target::Photo(photo.clone()),
        ),
        CameraDoubt::Cropped { photo, offset: [u, v] } => item(
            text::photo_cropped(photo, camera),
            text::photo_reframed_body().to_owned(),
            format!("{}, {} px", format::fixed(*u, 0), format::fixed(*v, 0)),
            Target::Photo(photo.clone()),
        ),
        CameraDoubt::OtherDistance { photo, value } => item(
            text::photo_other_distance(photo, camera),
            text::photo_other_distance_body().to_owned(),
            format::compact(*value),
            Target::Photo(photo.clone()),
        ),
    }
}
