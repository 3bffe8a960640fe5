//! Origin of a project or a calibration: assumptions, data not imported, and conversions.

use leptos::prelude::*;
use sightline::project::{Assumed, Conversion, Ignored, LocalSystem, Origin};

use super::components::icon::{Glyph, Icon};
use crate::format;
use crate::i18n::{interchange as words, speech};
use crate::store::Desk;
use crate::store::foreign::format_name;

/// Names shown of many files.
const SHOWN: usize = 3;

/// The sentence for an assumption.
pub fn assumed_words(assumed: Assumed) -> &'static str {
    match assumed {
        Assumed::SigmaOnePixel => words::assumed_sigma(),
        Assumed::ImageSizeFromPrincipalPoint => words::assumed_size_principal_point(),
        Assumed::MeasurementsFromCorner => words::assumed_from_corner(),
        Assumed::ImageSizeFromMeasurements => words::assumed_size_measurements(),
        Assumed::FourCoefficientsRadialTangential => words::assumed_four(),
        Assumed::UnitUnknown => words::assumed_unit(),
        Assumed::PixelOriginCorner => words::assumed_corner(),
        Assumed::SystemOfChunk => words::assumed_chunk(),
    }
}

/// The sentence for the local system of latitudes and longitudes.
fn local_system_words(system: LocalSystem) -> String {
    let LocalSystem { latitude, longitude, height, .. } = system;
    words::local_system_at(format::editable(latitude), format::editable(longitude), format::editable(height))
}

/// Contents that are not imported or cannot be written, with counts.
pub fn ignored_words(ignored: &[Ignored]) -> String {
    let one = |one: &Ignored| words::counted(speech().ignored(&one.name), format::count(one.count));
    ignored.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// A difference in pixels with enough digits to show that it is not 0.
fn pixels(value: f64) -> String {
    if value >= 0.0005 { format::fixed(value, 3) } else { "< 0.001".to_owned() }
}

/// Remaining difference of a conversion of a camera.
pub fn conversion_words(conversion: &Conversion) -> String {
    let Conversion { camera, from, to, max_px, rms_px, .. } = conversion;
    words::conversion(camera, from, to, pixels(*max_px), pixels(*rms_px))
}

/// A conversion, marked where the adjustment could feel it.
#[component]
pub fn ConversionLine(conversion: Conversion) -> impl IntoView {
    let large = conversion.warning;
    view! {
        <li class="conversion" class:warn=large>
            {large.then(|| view! { <Glyph icon=Icon::Warning size=12/> " " })}
            {move || conversion_words(&conversion)}
            {large.then(|| view! { " " {words::conversion_large} })}
        </li>
    }
}

/// File names in one line.
fn named(files: &[String]) -> String {
    let shown = files.iter().take(SHOWN).cloned().collect::<Vec<_>>().join(", ");
    match files.len().saturating_sub(SHOWN) {
        0 => shown,
        more => words::more_files(shown, more),
    }
}

/// Assumptions, contents not imported, and conversions.
#[component]
pub fn OriginNotes(origin: Origin) -> impl IntoView {
    let Origin { assumed, ignored, conversions, local_system, .. } = origin;
    let system =
        local_system.map(|system| view! { <li data-assumed="LocalSystem">{move || local_system_words(system)}</li> });
    let (any_assumed, any_ignored, any_converted) =
        (!assumed.is_empty() || system.is_some(), !ignored.is_empty(), !conversions.is_empty());
    view! {
        <dl class="origin-notes">
            {any_assumed.then(|| view! {
                <dt>{words::assumed}</dt>
                <dd><ul>{system}{assumed.into_iter().map(|one| view! { <li data-assumed=format!("{one:?}")>{move || assumed_words(one)}</li> }).collect_view()}</ul></dd>
            })}
            {any_converted.then(|| view! {
                <dt>{words::converted}</dt>
                <dd><ul>{conversions.into_iter().map(|conversion| view! { <ConversionLine conversion/> }).collect_view()}</ul></dd>
            })}
            {any_ignored.then(|| view! {
                <dt>{words::not_kept}</dt>
                <dd data-ignored="">{move || ignored_words(&ignored)}</dd>
            })}
        </dl>
    }
}

/// Where the open project comes from, in the steps that its consequences are in.
#[component]
pub fn ProjectOrigin() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let origin = Memo::new(move |_| desk.document.with(|d| d.project.origin.as_deref().cloned()));
    let panel = |origin: Origin| {
        let (format, key) = (origin.format.clone(), origin.format.clone());
        let files = named(&origin.files);
        view! {
            <section class="panel origin" data-origin=key>
                <h2 class="section-head">
                    <span>{move || match format.as_str() {
                        Origin::EARLIER => words::opened_from_earlier().to_owned(),
                        Origin::LIST => words::local_system().to_owned(),
                        foreign => words::opened_from(format_name(foreign)),
                    }}</span>
                    <span class="aside">{files}</span>
                </h2>
                <OriginNotes origin/>
            </section>
        }
    };
    move || origin.get().map(panel)
}

/// Where a calibration comes from, in a line.
pub fn read_from(origin: &Origin) -> String {
    if !origin.is_foreign() {
        return words::kept_by_earlier(ignored_words(&origin.ignored));
    }
    words::read_from(format_name(&origin.format), named(&origin.files))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::i18n::{Language, in_language};
    use sightline::project::RemovedFields;

    #[test]
    fn every_assumption_has_its_sentence_in_both_languages() {
        let all = [
            Assumed::SigmaOnePixel,
            Assumed::ImageSizeFromPrincipalPoint,
            Assumed::MeasurementsFromCorner,
            Assumed::ImageSizeFromMeasurements,
            Assumed::FourCoefficientsRadialTangential,
            Assumed::UnitUnknown,
            Assumed::PixelOriginCorner,
            Assumed::SystemOfChunk,
        ];
        for language in Language::ALL {
            let said: std::collections::BTreeSet<_> = in_language(language, || all.map(assumed_words)).into();
            assert_eq!(said.len(), all.len(), "{language:?}");
        }
    }

    #[test]
    fn what_is_not_kept_is_counted_and_translated() {
        let of = |name: &str, count| Ignored { name: name.into(), count };
        let all = [of("colours of points", 12), of("<own element>", 1)];
        assert_eq!(in_language(Language::English, || ignored_words(&all)), "colours of points: 12, <own element>: 1");
        assert_eq!(in_language(Language::Korean, || ignored_words(&all)), "점의 색: 12, <own element>: 1");
        for name in RemovedFields::NAMES {
            let [en, ko] = Language::ALL.map(|language| in_language(language, || ignored_words(&[of(name, 1)])));
            assert!(en.starts_with(name) && !ko.starts_with(name), "{en} {ko}");
        }
        let earlier = Origin {
            format: Origin::EARLIER.into(),
            ignored: vec![of(RemovedFields::OF_CAMERAS, 1)],
            ..Origin::default()
        };
        let said = in_language(Language::English, || read_from(&earlier));
        assert!(said.contains("earlier version") && said.contains(RemovedFields::OF_CAMERAS), "{said}");
    }

    #[test]
    fn small_differences_are_not_shown_as_none() {
        assert_eq!((pixels(0.0), pixels(0.0012), pixels(3.2)), ("< 0.001".into(), "0.001".into(), "3.200".into()));
    }
}
