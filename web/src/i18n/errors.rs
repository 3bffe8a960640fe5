//! The engine's errors as sentences: what is wrong, where, and what to do.

use sightline::Error;
use sightline::error::{Damage, Defect, Lack, Place, Reason, Thing};
use sightline::initial::Degeneracy;

use super::{Language, language, reasons, texts};

texts! {
    recognised(kind): "this is a {kind} file, which is not read here: convert it to JPEG, PNG or TIFF", "{kind} 파일입니다. 여기서는 읽지 못하므로 JPEG, PNG, TIFF로 변환하십시오";
    no_picture: "not a picture that is read here: JPEG, PNG or TIFF of 8 or 16 bits are expected", "읽을 수 있는 사진이 아닙니다. 8·16비트 JPEG, PNG, TIFF가 필요합니다";
    broken(detail): "the picture cannot be decoded ({detail}): copy it again from the camera", "사진을 복호할 수 없습니다({detail}). 카메라에서 다시 복사하십시오";
    size(width, height, limit): "the picture has {width} × {height} pixels; from 1 to {limit} pixels are worked on", "사진이 {width} × {height} 화소입니다. 1화소부터 {limit}화소까지 처리합니다";
    unknown(kind, name): "there is no {kind} \"{name}\"", "{kind} \"{name}\" 이(가) 없습니다";
    duplicate(kind, name): "the {kind} \"{name}\" occurs twice: identifiers are unique", "{kind} \"{name}\" 이(가) 두 번 나옵니다. 식별자는 서로 달라야 합니다";
    empty(what): "the project has no {what} to work on", "프로젝트에 처리할 {what}이(가) 없습니다";
    initial_values(things): "initial values are missing for {things}", "초기값이 없습니다: {things}";
    not_solved(causes): "the network cannot be solved: {causes}", "망을 풀 수 없습니다: {causes}";
    stopped: "stopped on request", "요청에 따라 중지했습니다";
    and_more(names, more): "{names} and {more} more", "{names} 외 {more}";
    no_datum(missing): "{missing} of the 7 datum parameters (position, attitude, scale) are not fixed: add control points or a distance, or choose the minimal or the free datum",
        "기준계 매개변수 7개(위치, 자세, 축척) 가운데 {missing}개가 정해지지 않았습니다. 기준점이나 거리를 더하거나 최소구속 또는 자유망을 고르십시오";
    too_few_rays(points): "too few rays for point {points}: measure it in a second photo, give it coordinates or exclude it",
        "광선이 부족한 점 {points}: 두 번째 사진에서 측정하거나 좌표를 주거나 제외하십시오";
    photo_undetermined(photos): "too few points in photo {photos}: measure at least three well-spread points that other photos or the control determine, or exclude the photo",
        "점이 부족한 사진 {photos}: 다른 사진이나 기준점으로 정해지는 점을 셋 이상 고르게 측정하거나 사진을 제외하십시오";
    not_tied(groups): "groups of photos are not tied to each other ({groups}): measure common points",
        "사진 묶음이 서로 이어지지 않습니다({groups}). 공통점을 측정하십시오";
    parameter_undetermined(camera, parameters): "camera {camera}: the network does not determine {parameters}: hold it, observe it with a sigma, or add convergent and rolled photos",
        "카메라 {camera}: 망이 {parameters}을(를) 정하지 못합니다. 고정하거나 표준오차와 함께 관측값으로 주거나, 수렴·회전 촬영 사진을 더하십시오";
    combination(things): "the network does not determine a combination of {things}: hold or observe some of them, or add rays",
        "망이 다음의 조합을 정하지 못합니다: {things}. 일부를 고정하거나 관측값으로 주거나 광선을 더하십시오";
    kind_photo: "photo", "사진";
    kind_point: "point", "점";
    kind_camera: "camera", "카메라";
    kind_file: "file", "파일";
    kind_line: "line", "행";
    kind_field: "field", "항목";
    some_photos: "photos", "사진";
    some_points: "points", "점";
    some_cameras: "cameras", "카메라";
    some_parameters: "parameters", "매개변수";
}

/// An error as a sentence in the language in use.
pub fn sentence(error: &Error) -> String {
    let text = match error {
        Error::UnknownImageFormat { recognised: Some(kind), .. } => recognised(kind),
        Error::UnknownImageFormat { .. } => no_picture().to_owned(),
        Error::BrokenImage { reason, .. } => broken(damaged(reason)),
        Error::ImageSize { width, height, limit, .. } => size(width, height, limit),
        Error::Invalid { reason, .. } => because(reason),
        Error::Unknown { kind, name, .. } => unknown(thing(*kind), name),
        Error::Duplicate { kind, name, .. } => duplicate(thing(*kind), name),
        Error::Empty { what } => empty(lack(*what)),
        Error::MissingInitialValues { photos, points, cameras } => {
            initial_values(things(&[(some_photos(), photos), (some_points(), points), (some_cameras(), cameras)]))
        }
        Error::RankDefect { defects } => not_solved(defects.iter().map(defect).collect::<Vec<_>>().join("; ")),
        Error::CannotOrient { reason, photos } if photos.is_empty() => degenerate(reason),
        Error::CannotOrient { reason, photos } => {
            format!("{} ({} {})", degenerate(reason), some_photos(), listed(photos))
        }
        Error::Cancelled => stopped().to_owned(),
    };
    let mut text = capitalised(&text);
    let place = match error {
        Error::RankDefect { .. }
        | Error::MissingInitialValues { .. }
        | Error::CannotOrient { .. }
        | Error::Empty { .. } => String::new(),
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

fn because(reason: &Reason) -> String {
    match language() {
        Language::English => reason.to_string(),
        Language::Korean => reasons::reason(reason),
    }
}

fn damaged(damage: &Damage) -> String {
    match language() {
        Language::English => damage.to_string(),
        Language::Korean => reasons::damage(damage),
    }
}

fn degenerate(degeneracy: &Degeneracy) -> String {
    match language() {
        Language::English => degeneracy.to_string(),
        Language::Korean => reasons::degeneracy(degeneracy),
    }
}

fn thing(thing: Thing) -> &'static str {
    match language() {
        Language::English => thing.name(),
        Language::Korean => reasons::thing(thing),
    }
}

fn lack(lack: Lack) -> &'static str {
    match language() {
        Language::English => lack.name(),
        Language::Korean => reasons::lack(lack),
    }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// At most five names, then how many more there are.
fn listed(names: &[String]) -> String {
    let shown = names.iter().take(5).cloned().collect::<Vec<_>>().join(", ");
    match names.len().saturating_sub(5) {
        0 => shown,
        more => and_more(shown, more),
    }
}

fn things(groups: &[(&str, &Vec<String>)]) -> String {
    let full = groups.iter().filter(|(_, names)| !names.is_empty());
    full.map(|(kind, names)| format!("{kind} {}", listed(names))).collect::<Vec<_>>().join("; ")
}

fn defect(defect: &Defect) -> String {
    match defect {
        Defect::NoDatum { missing } => no_datum(missing),
        Defect::TooFewRays { points } => too_few_rays(listed(points)),
        Defect::PhotoUndetermined { photos } => photo_undetermined(listed(photos)),
        Defect::NotTied { groups } => not_tied(groups.iter().map(|g| listed(g)).collect::<Vec<_>>().join(" | ")),
        Defect::ParameterUndetermined { camera, parameters } => parameter_undetermined(camera, listed(parameters)),
        Defect::Combination { points, photos, parameters } => {
            combination(things(&[(some_points(), points), (some_photos(), photos), (some_parameters(), parameters)]))
        }
    }
}

fn place_words(place: &Place) -> String {
    let line = place.line.map(|line| match language() {
        Language::English => format!("{} {line}", kind_line()),
        Language::Korean => format!("{line}{}", kind_line()),
    });
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
