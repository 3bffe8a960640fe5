//! The engine's errors as sentences: what is wrong, where, and what to do.

use sightline::Error;
use sightline::error::{Defect, Place};

use super::en::errors::*;
use super::name_list::name_list;
use super::speech;

/// An error as a sentence in the language in use.
pub fn sentence(error: &Error) -> String {
    let text = match error {
        Error::UnknownImageFormat { recognised: Some(kind), .. } if kind.is_raw() => raw_unread(speech().picture(kind)),
        Error::UnknownImageFormat { recognised: Some(kind), .. } => recognised(speech().picture(kind)),
        Error::UnknownImageFormat { .. } => no_picture().to_owned(),
        Error::BrokenImage { reason, .. } => broken(speech().damage(reason)),
        Error::DecoderMissing { format, message, .. } => decoder_missing(format, message),
        Error::ImageSize { width, height, limit, .. } => size(width, height, limit),
        Error::Invalid { reason, .. } => speech().reason(reason),
        Error::Unknown { kind, name, .. } => unknown(speech().thing(*kind), name),
        Error::Duplicate { kind, name, .. } => duplicate(speech().thing(*kind), name),
        Error::Empty { what } => empty(speech().lack(*what)),
        Error::MissingInitialValues { photos, points, cameras } => {
            initial_values(things(&[(some_photos(), photos), (some_points(), points), (some_cameras(), cameras)]))
        }
        Error::RankDefect { defects } => not_solved(defects.iter().map(defect).collect::<Vec<_>>().join("; ")),
        Error::ControlDisagrees { agreeing, disagreeing } if agreeing.is_empty() => {
            control_disagrees_all(name_list(disagreeing))
        }
        Error::ControlDisagrees { agreeing, disagreeing } => {
            control_disagrees(name_list(disagreeing), agreeing.len(), name_list(agreeing))
        }
        Error::CannotOrient { reason, photos } if photos.is_empty() => speech().degeneracy(reason),
        Error::CannotOrient { reason, photos } => {
            format!("{} ({} {})", speech().degeneracy(reason), some_photos(), name_list(photos))
        }
        Error::Cancelled => stopped().to_owned(),
    };
    let mut text = capitalised(&text);
    let place = match error {
        Error::RankDefect { .. }
        | Error::MissingInitialValues { .. }
        | Error::CannotOrient { .. }
        | Error::ControlDisagrees { .. }
        | Error::Empty { .. } => String::new(),
        // Its sentence names the epoch.
        Error::Invalid { at, .. }
            if at.field.as_deref().is_some_and(|field| field.starts_with("epochs[") && !field.contains('.')) =>
        {
            String::new()
        }
        _ => place_words(&error.place()),
    };
    if !place.is_empty() {
        text.push_str(&format!(" ({place})"));
    }
    if !text.ends_with(['.', ')']) {
        text.push('.');
    }
    text
}

/// The sentence for a number that is not taken as typed: with both readings where there are two, else why not.
pub fn refusal(typed: &str, why: fn(String) -> String) -> String {
    match crate::format::ambiguous(typed) {
        Some([decimal, thousands]) => super::text::ambiguous_number(typed, decimal, thousands),
        None => why(typed.to_owned()),
    }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn things(groups: &[(&str, &Vec<String>)]) -> String {
    let full = groups.iter().filter(|(_, names)| !names.is_empty());
    full.map(|(kind, names)| format!("{kind} {}", name_list(*names))).collect::<Vec<_>>().join("; ")
}

fn defect(defect: &Defect) -> String {
    match defect {
        Defect::NoDatum { missing } => no_datum(missing),
        Defect::TooFewRays { points } => too_few_rays(name_list(points)),
        Defect::PhotoUndetermined { photos } => photo_undetermined(name_list(photos)),
        Defect::NotTied { groups } => not_tied(groups.iter().map(name_list).collect::<Vec<_>>().join(" | ")),
        Defect::ParameterUndetermined { camera, parameters } => parameter_undetermined(camera, name_list(parameters)),
        Defect::Combination { points, photos, parameters } => {
            combination(things(&[(some_points(), points), (some_photos(), photos), (some_parameters(), parameters)]))
        }
        Defect::OneStation { photos } => all_one_station(name_list(photos)),
    }
}

fn place_words(place: &Place) -> String {
    let line = place.line.map(kind_line);
    let named = |kind: &str, value: &Option<String>| value.as_ref().map(|value| format!("{kind} {value}"));
    [
        named(kind_file(), &place.file),
        named(kind_camera(), &place.camera),
        named(kind_photo(), &place.photo),
        named(kind_point(), &place.point),
        line,
        named(kind_field(), &place.field),
    ]
    .into_iter()
    .flatten()
    .collect::<Vec<_>>()
    .join(", ")
}
