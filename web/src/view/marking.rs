//! Measuring a point in photo after photo: questions about the selected point in the photo shown, with one key or button
//! per answer.

use leptos::prelude::*;

use super::components::field::Field;
use crate::format;
use crate::i18n::text;
use crate::store::Desk;

/// A button with the key that does the same.
#[component]
pub fn Keyed(
    words: fn() -> &'static str,
    key: &'static str,
    on_click: Callback<()>,
    #[prop(optional)] primary: bool,
    action: &'static str,
) -> impl IntoView {
    view! {
        <button class="button small" class:primary=primary type="button" data-action=action on:click=move |_| on_click.run(())>
            {words} " " <kbd>{key}</kbd>
        </button>
    }
}

/// Question about the selected point in this photo: whether a target is it, or where to go next.
#[component]
pub fn MarkingBar() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let point = Memo::new(move |_| desk.selection.with(|s| s.point.clone()));
    let here = Memo::new(move |_| desk.measured_here());
    let candidates = Memo::new(move |_| desk.candidates_here());
    let place = Memo::new(move |_| desk.prediction_here().filter(|p| p.inside));
    // The naming of a target or place has the row while it is asked.
    let naming =
        Memo::new(move |_| desk.selection.with(|s| s.point.is_none() && (s.target.is_some() || s.spot.is_some())));
    let shown = move || {
        desk.asked_question().is_none()
            && !naming.get()
            && (desk.in_series() || (!here.get() && point.with(Option::is_some) && place.with(Option::is_some)))
    };
    let off = move |target: usize| {
        let photo = desk.selection.with(|s| s.photo.clone())?;
        let [pu, pv] = place.get()?.place?;
        desk.document.with(|d| {
            let t = d.detections.get(&photo)?.targets.get(target)?;
            Some(format::fixed((t.u - pu).hypot(t.v - pv), 1))
        })
    };
    let sentence = move || {
        let Some(point) = point.get() else { return text::click_next_point().to_owned() };
        if here.get() {
            return text::point_is_measured_here(point);
        }
        let reach = place.get().and_then(|p| p.ellipse(3.0)).map(|e| format::fixed(e[0], 1));
        match (candidates.get().as_slice(), reach) {
            ([(target, _), rest @ ..], Some(reach)) => {
                let first = off(*target).unwrap_or_default();
                match rest.first().and_then(|(target, _)| off(*target)) {
                    Some(second) => text::is_it_of_two(point, first, reach, second),
                    None => text::is_it(point, first, reach),
                }
            }
            ([], Some(reach)) => text::should_be_here(point, reach),
            ([(target, _), ..], None) => text::is_it_near(point, off(*target).unwrap_or_default()),
            ([], None) if place.get().is_some_and(|p| p.place.is_some()) => text::should_be_near(point),
            _ => text::click_point_here(point),
        }
    };
    let takes = move || !here.get() && point.with(Option::is_some) && place.with(Option::is_some);
    view! {
        <Show when=shown>
            <div class="question marking" role="group" aria-label=text::measuring_by_hand>
                <p>{sentence}</p>
                <Show when=move || desk.in_series() && point.with(Option::is_none)>
                    <label><span>{text::name}</span>
                        <Field value=Signal::derive(move || desk.measuring.series.with(|s| s.as_ref().map(|s| s.next.clone()).unwrap_or_default()))
                            commit=move |typed: String| desk.set_next_name(&typed) attr:name="next-name"/>
                    </label>
                </Show>
                <Show when=takes>
                    <Keyed words=text::yes key="Y" primary=true action="take" on_click=Callback::new(move |()| desk.take_candidate())/>
                </Show>
                <Show when=move || point.with(Option::is_some)>
                    <Keyed words=text::next_place key="N" action="next-place" on_click=Callback::new(move |()| desk.next_place())/>
                    <Show when=move || desk.in_series()>
                        <Keyed words=text::next_point key="P" action="next-point" on_click=Callback::new(move |()| desk.finish_point())/>
                    </Show>
                </Show>
            </div>
        </Show>
    }
}
