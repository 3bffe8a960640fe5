//! Step 2: targets detected in the photos, with centre, standard errors and outline.

use leptos::prelude::*;
use sightline::detection::{Channel, CodeNote, Codes, Detection, Method, Polarity, PolarityChoice, Reason, Target};
use sightline::ring_code::Family;

use super::components::field::Field;
use super::components::icon::{Glyph, Icon};
use super::lateral_colour::LateralColour;
use super::loupe::Loupe;
use super::marking::MarkingBar;
use super::photo_view::{Click, Mark, PhotoView, Style, half_turn_degrees};
use super::picking::{Question, chosen_target, pick, spot_mark};
use super::strip::Strip;
use crate::browser::event;
use crate::document::rings::Rings;
use crate::edit::targets::candidates;
use crate::format;
use crate::i18n::{Text, errors, first, printing, text};
use crate::store::{Desk, Step};
use crate::view::components::title::TitleBar;

#[component]
pub fn Targets() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sentence = move || {
        let (photos, targets, coded) = desk.document.with(|d| {
            let targets = || d.detections.values().flat_map(|detection| &detection.targets);
            (d.detections.len(), targets().count(), targets().filter(|t| t.code.is_some()).count())
        });
        if photos == 0 {
            text::targets_none_yet().to_owned()
        } else {
            let sentence = text::targets_sentence(format::count(targets), format::count(coded), format::count(photos));
            match desk.document.with(|d| d.rings.clone()) {
                Rings::Of(Some(family)) if coded > 0 => format!("{sentence} {}", text::codes_of(family_words(family))),
                _ => sentence,
            }
        }
    };
    let again = move || desk.document.with(|d| !d.detections.is_empty());
    let marks = Signal::derive(move || target_marks(desk));
    let summary = Signal::derive(move || {
        current(desk).map_or(String::new(), |d| {
            let coded = d.targets.iter().filter(|t| t.code.is_some()).count();
            text::targets_coded(format::count(d.targets.len()), format::count(coded))
        })
    });
    let on_click = Callback::new(move |click: Click| pick(desk, click));
    let selected = Signal::derive(move || chosen_target(desk).map(|t| [t.u, t.v, t.major, t.minor, t.angle]));
    view! {
        <TitleBar title=text::targets sentence=Signal::derive(sentence)>
            <button class="button" data-open="print" on:click=move |_| desk.go(Step::Print)>{printing::targets_to_print}</button>
            <button class="button" class:primary=move || !again() data-action="detect" on:click=move |_| desk.detect_targets()>
                {move || if again() { text::detect_again() } else { text::detect() }}
            </button>
            <Show when=again>
                <button class="button primary" on:click=move |_| desk.go(Step::Identities)>{text::identities} <Glyph icon=Icon::Arrow/></button>
            </Show>
        </TitleBar>
        <main class="targets">
            <Strip/>
            <PhotoView marks strokes=Signal::derive(Vec::new) summary on_click><Question targets=false/><MarkingBar/></PhotoView>
            <aside class="inspector" tabindex="0" aria-label=text::target>
                <FamilyQuestion/>
                <details class="options" open=move || !again()>
                    <summary>{first::detection_options}</summary>
                    <Options/>
                </details>
                <Loupe target=selected/>
                <TargetDetails/>
                <PictureNote/>
                <LateralColour/>
                <RejectedTable/>
            </aside>
        </main>
    }
}

fn current(desk: Desk) -> Option<std::sync::Arc<Detection>> {
    let photo = desk.selection.with(|s| s.photo.clone())?;
    desk.document.with(|d| d.detections.get(&photo).cloned())
}

/// The targets of the photo that is shown.
fn target_marks(desk: Desk) -> Vec<Mark> {
    let Some(detection) = current(desk) else { return spot_mark(desk).into_iter().collect() };
    let chosen = chosen_target(desk).map(|t| t.id);
    let rings = desk.document.with(|d| d.rings.clone());
    let mark = |t: &Target| Mark {
        u: t.u,
        v: t.v,
        major: t.major,
        minor: t.minor,
        angle: t.angle,
        label: t.code.map(|code| code.to_string()),
        strong: t.code.is_some(),
        style: match t.id {
            id if Some(id) == chosen => Style::Selected,
            _ if t.occluded => Style::Hidden,
            _ if !candidates(t, &rings).is_empty() => Style::Doubtful,
            _ => Style::Measured,
        },
    };
    detection.targets.iter().map(mark).chain(hidden_marks(&detection)).chain(spot_mark(desk)).collect()
}

/// Places at which something hides too much of a target to measure it.
fn hidden_marks(detection: &Detection) -> impl Iterator<Item = Mark> {
    let hidden = detection.rejected_blobs.iter().filter(|blob| blob.reason == Reason::Occluded);
    hidden.map(|blob| Mark {
        u: blob.u,
        v: blob.v,
        major: blob.diameter,
        minor: blob.diameter,
        angle: 0.0,
        label: None,
        strong: false,
        style: Style::Hidden,
    })
}

/// A choice among named values.
#[component]
fn Choice<T: Copy + PartialEq + Send + Sync + 'static>(
    label: fn() -> &'static str,
    name: &'static str,
    values: Vec<(T, Text)>,
    get: fn(Desk) -> T,
    set: fn(Desk, T),
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let all = StoredValue::new(values.clone());
    view! {
        <label class="option">
            <span>{label}</span>
            <select name=name on:change=move |e| {
                let chosen = event::value(&e).parse::<usize>().ok();
                if let Some((value, _)) = chosen.and_then(|i| all.with_value(|all| all.get(i).copied())) {
                    set(desk, value);
                }
            }>
                {values.into_iter().enumerate().map(|(i, (value, words))| view! {
                    <option value=i selected=move || get(desk) == value>{words}</option>
                }).collect_view()}
            </select>
        </label>
    }
}

/// A family of codes by its maker's name, the same in every language.
fn family_words(family: Family) -> &'static str {
    match family {
        Family::Ring12 => "Schneider / AICON 12 bit",
        Family::Ring14 => "Schneider / AICON 14 bit",
        Family::Ring16 => "Schneider / AICON 16 bit",
        Family::Ring20 => "Schneider / AICON 20 bit",
        Family::Metashape12 => "Metashape 12 bit",
        Family::Metashape14 => "Metashape 14 bit",
        Family::Metashape16 => "Metashape 16 bit",
        Family::Metashape20 => "Metashape 20 bit",
    }
}

/// Asks for the family of the codes where the photos leave it open.
#[component]
fn FamilyQuestion() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let rings = Memo::new(move |_| desk.document.with(|d| d.rings.clone()));
    move || match rings.get() {
        Rings::Of(_) => ().into_any(),
        Rings::Different => view! { <p class="note" role="status">{text::codes_different}</p> }.into_any(),
        Rings::OfSeveral(families) => view! {
            <p class="note" role="status">
                {text::codes_of_several} " "
                {families.into_iter().map(|family| view! {
                    <button class="button small" type="button" on:click=move |_| desk.choose_family(family)>
                        {family_words(family)}
                    </button>
                }).collect_view()}
            </p>
        }
        .into_any(),
    }
}

/// Options of the detection; the defaults work without tuning.
#[component]
fn Options() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let diameter = move |typed: String, set: fn(Desk, f64)| match format::parse(&typed).filter(|d| *d >= 1.0) {
        Some(value) => set(desk, value),
        None => desk.warn_here(move || errors::refusal(&typed, text::not_a_length)),
    };
    // an axis ratio of 0.15, the least that is taken, is a view from 81 degrees
    let steepest = move |typed: String| match format::parse(&typed).filter(|degrees| (0.0..=81.0).contains(degrees)) {
        Some(degrees) => desk.processing.detect_options.update(|o| o.min_axis_ratio = degrees.to_radians().cos()),
        None => desk.warn_here(move || errors::refusal(&typed, text::no_steepest)),
    };
    view! {
        <Choice label=text::polarity name="polarity"
            values=vec![
                (PolarityChoice::Auto, text::polarity_both as Text),
                (PolarityChoice::Bright, text::polarity_bright),
                (PolarityChoice::Dark, text::polarity_dark),
            ]
            get=|desk| desk.processing.detect_options.with(|o| o.polarity)
            set=|desk, value| desk.processing.detect_options.update(|o| o.polarity = value)/>
        <Choice label=text::channel name="channel"
            values=vec![
                (Channel::Grey, text::channel_grey as Text),
                (Channel::Green, text::channel_green),
                (Channel::Red, text::channel_red),
                (Channel::Blue, text::channel_blue),
            ]
            get=|desk| desk.processing.detect_options.with(|o| o.channel)
            set=|desk, value| desk.processing.detect_options.update(|o| o.channel = value)/>
        <Choice label=text::codes name="codes"
            values=vec![
                (Codes::Auto, text::codes_auto as Text),
                (Codes::None, text::codes_none),
                (Codes::Ring12, || family_words(Family::Ring12)),
                (Codes::Ring14, || family_words(Family::Ring14)),
                (Codes::Ring16, || family_words(Family::Ring16)),
                (Codes::Ring20, || family_words(Family::Ring20)),
                (Codes::Metashape12, || family_words(Family::Metashape12)),
                (Codes::Metashape14, || family_words(Family::Metashape14)),
                (Codes::Metashape16, || family_words(Family::Metashape16)),
                (Codes::Metashape20, || family_words(Family::Metashape20)),
            ]
            get=|desk| desk.processing.detect_options.with(|o| o.codes)
            set=|desk, value| desk.processing.detect_options.update(|o| o.codes = value)/>
        <Choice label=text::method name="method"
            values=vec![
                (Method::LeastSquares, text::method_least_squares as Text),
                (Method::Ellipse, text::method_ellipse),
                (Method::Intensity, text::method_intensity),
                (Method::Gradient, text::method_gradient),
            ]
            get=|desk| desk.processing.detect_options.with(|o| o.method)
            set=|desk, value| desk.processing.detect_options.update(|o| o.method = value)/>
        <label class="option">
            <span>{text::diameter} " " <u>"px"</u></span>
            <Field value=Signal::derive(move || desk.processing.detect_options.with(|o| format::editable(o.min_diameter)))
                commit=move |typed: String| diameter(typed, |desk, d| desk.processing.detect_options.update(|o| o.min_diameter = d))
                attr:class="short" attr:inputmode="decimal" attr:name="min-diameter" attr:aria-label=text::diameter_from/>
            "–"
            <Field value=Signal::derive(move || desk.processing.detect_options.with(|o| format::editable(o.max_diameter)))
                commit=move |typed: String| diameter(typed, |desk, d| desk.processing.detect_options.update(|o| o.max_diameter = d))
                attr:class="short" attr:inputmode="decimal" attr:name="max-diameter" attr:aria-label=text::diameter_to/>
        </label>
        <label class="option">
            <span>{text::steepest} " " <u>"°"</u></span>
            <Field value=Signal::derive(move || {
                    let ratio = desk.processing.detect_options.with(|o| o.min_axis_ratio);
                    format::editable((ratio.acos().to_degrees() * 10.0).round() / 10.0)
                })
                commit=steepest
                attr:class="short" attr:inputmode="decimal" attr:name="steepest" attr:aria-label=text::steepest_view/>
        </label>
    }
}

/// The numbers of the selected target.
#[component]
pub fn TargetDetails() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let target = Memo::new(move |_| chosen_target(desk));
    let name = move || desk.selection.with(|s| s.point.clone());
    view! {
        <h2 class="section-head">
            <span>{text::target} " " <span class="id">{move || target.get().and_then(|t| t.code).map(|c| c.to_string())}</span></span>
            <span class="aside">"1σ"</span>
        </h2>
        {move || match target.get() {
            None => view! { <p class="note">{text::click_a_target}</p> }.into_any(),
            Some(t) => {
                let place = |value: f64, sigma: f64| {
                    let decimals = format::decimals_for(sigma).max(2);
                    view! { <b>{format::fixed(value, decimals)}</b> " " <i>"± " {format::fixed(sigma, decimals)}</i> " px" }
                };
                let polarity = t.polarity;
                view! {
                    <dl class="pairs">
                        <dt>{text::point}</dt><dd data-result="point">{move || name().unwrap_or_else(|| text::no_name().to_owned())}</dd>
                        <dt>"u"</dt><dd>{place(t.u, t.sigma_u)}</dd>
                        <dt>"v"</dt><dd>{place(t.v, t.sigma_v)}</dd>
                        <dt>{text::full_axes}</dt><dd>{format!("{} × {} px", format::fixed(t.major, 2), format::fixed(t.minor, 2))}</dd>
                        <dt>{text::rotation}</dt><dd>{format!("{}°", format::fixed(half_turn_degrees(t.angle), 1))}</dd>
                        <dt>{text::contrast}</dt><dd>{format::fixed(t.contrast, 0)}</dd>
                        <dt>{text::polarity}</dt>
                        <dd>{move || match polarity {
                            Polarity::Bright => text::polarity_bright(),
                            Polarity::Dark => text::polarity_dark(),
                        }}</dd>
                        {Some(candidates_words(&t, &desk.document.with(|d| d.rings.clone()))).filter(|words| !words.is_empty()).map(|words| {
                            view! { <dt>{text::code_candidates}</dt><dd data-result="code-candidates">{words}</dd> }
                        })}
                        {t.quality.code_note.map(|note| view! { <dt>{text::code_not_read}</dt><dd data-result="code-note">{move || code_note(note)}</dd> })}
                        {t.occluded.then(|| {
                            let share = format::fixed(100.0 * t.quality.occluded, 0);
                            view! { <dt>{text::reason_occluded}</dt><dd data-result="occluded">{move || text::occluded_share(&share)}</dd> }
                        })}
                        {t.inner.map(|inner| {
                            let words = if inner.off_centre { text::inner_rim_off() } else { text::inner_rim_centred() };
                            let apart = format::fixed((inner.u - t.u).hypot(inner.v - t.v), 2);
                            view! { <dt>{text::inner_rim}</dt><dd data-result="inner-rim">{format!("{} × {} px, {apart} px: {words}", format::fixed(inner.major, 1), format::fixed(inner.minor, 1))}</dd> }
                        })}
                        <dt>{text::edge_width}</dt><dd>{format!("{} px", format::fixed(t.quality.edge_width, 2))}</dd>
                    </dl>
                }.into_any()
            }
        }}
    }
}

/// Candidate codes of a ring by family; empty if a code was read, or there is no ring.
fn candidates_words(target: &Target, rings: &Rings) -> String {
    let of = |(family, numbers): (Family, Vec<u32>)| {
        let numbers = numbers.iter().map(u32::to_string).collect::<Vec<_>>();
        format!("{}: {}", family_words(family), numbers.join(", "))
    };
    candidates(target, rings).into_iter().map(of).collect::<Vec<_>>().join("; ")
}

fn code_note(note: CodeNote) -> &'static str {
    match note {
        CodeNote::AllSet => text::code_all_set(),
        CodeNote::NoCode => text::code_no_code(),
        CodeNote::Disturbed => text::code_disturbed(),
        CodeNote::BetweenLevels => text::code_between_levels(),
        CodeNote::OtherFamily => text::code_other_family(),
        CodeNote::Uncertain => text::code_uncertain(),
        CodeNote::SeveralFamilies => text::code_several_families(),
        CodeNote::Unread => text::code_unread(),
    }
}

/// Processing of the photo by the camera, its effect on the standard errors, and how many targets are not used.
#[component]
fn PictureNote() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sentence = move || {
        let Some(d) = current(desk) else { return String::new() };
        let measured = match &d.measured {
            Some(measured) => super::measured::sentence(measured, &d.picture),
            None => super::measured::picture_sentence(&d.picture),
        };
        let photo = desk.selection.with(|s| s.photo.clone());
        let corrections = desk.photos.files.with(|files| {
            let file = files.get(&photo?)?;
            super::corrections::sentence(&file.name, &file.info)
        });
        let occluded = d.targets.iter().filter(|target| target.occluded).count();
        let occluded = (occluded > 0).then(|| text::occluded_here(occluded as u64));
        [Some(measured).filter(|text| !text.is_empty()), occluded, corrections]
            .into_iter()
            .flatten()
            .collect::<Vec<_>>()
            .join(" ")
    };
    view! {
        <Show when=move || !sentence().is_empty()>
            <p class="note" data-result="picture">{sentence}</p>
        </Show>
    }
}

/// Number of rejected blobs of the photo by reason.
#[component]
fn RejectedTable() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let rejected = Memo::new(move |_| current(desk).map(|d| d.rejected.clone()).unwrap_or_default());
    view! {
        <Show when=move || rejected.with(|r| !r.is_empty())>
            <h2 class="section-head">
                <span>{text::rejected_here}</span>
                <span class="aside">{move || format::count(rejected.with(|r| r.values().sum()))}</span>
            </h2>
            <div class="scroll" tabindex="0" role="region" aria-label=text::rejected_here>
                <table class="table rejected">
                    <tbody>
                        {move || {
                            let mut rows = rejected.get().into_iter().collect::<Vec<_>>();
                            rows.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
                            rows.into_iter().map(|(reason, count)| view! {
                                <tr><td class="left">{move || reason_words(reason)}</td><td>{format::count(count)}</td></tr>
                            }).collect_view()
                        }}
                    </tbody>
                </table>
            </div>
        </Show>
    }
}

fn reason_words(reason: Reason) -> &'static str {
    match reason {
        Reason::TooSmall => text::reason_too_small(),
        Reason::TooLarge => text::reason_too_large(),
        Reason::NotAnEllipse => text::reason_not_an_ellipse(),
        Reason::TooFlat => text::reason_too_flat(),
        Reason::LowContrast => text::reason_low_contrast(),
        Reason::Touching => text::reason_touching(),
        Reason::Saturated => text::reason_saturated(),
        Reason::AtBorder => text::reason_at_border(),
        Reason::Occluded => text::reason_occluded(),
        Reason::CodeRing => text::reason_code_ring(),
        Reason::NoFit => text::reason_no_fit(),
    }
}

#[cfg(test)]
mod tests {
    use sightline::detection::Rejected;

    use super::*;

    #[test]
    fn of_what_was_rejected_the_hidden_targets_are_marked_at_their_places() {
        let blob = |u: f64, reason| Rejected { u, v: 20.0, diameter: 14.0, reason };
        let rejected_blobs =
            vec![blob(1.0, Reason::NotAnEllipse), blob(5.0, Reason::Occluded), blob(9.0, Reason::CodeRing)];
        let marks = hidden_marks(&Detection { rejected_blobs, ..Detection::default() }).collect::<Vec<_>>();
        let [mark] = &marks[..] else { panic!("{marks:?}") };
        assert_eq!((mark.u, mark.v, mark.major, mark.minor, mark.style), (5.0, 20.0, 14.0, 14.0, Style::Hidden));
    }
}
