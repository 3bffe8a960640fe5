//! A worker's side: every request is one call into the engine.

use std::cell::RefCell;
use std::hash::{DefaultHasher, Hash, Hasher};

use sightline::adjust::{adjust, apply};
use sightline::adjustment::{AdjustOptions, StatisticsChoice};
use sightline::detection::{Channel, Codes, DetectOptions};
use sightline::exchange::package::{self, Package};
use sightline::experiments::{self, ExperimentOptions};
use sightline::image::Grey;
use sightline::matching::{MatchOptions, PhotoTargets, match_uncoded};
use sightline::orient::orient;
use sightline::project::Project;
use sightline::{Result, decode, detect, exif, sample};

use crate::browser::worker::Reply;
use crate::protocol::{Answer, Content, Opened, Request};

type Outcome = Result<(Answer, Vec<Vec<u8>>)>;

/// Serves one request; `answer` sends progress and the end.
pub fn serve(request: Request, files: Vec<Vec<u8>>, answer: Reply) {
    let file = files.first().map(Vec::as_slice).unwrap_or_default();
    let outcome = match request {
        Request::Open { max_side } => open(file, max_side),
        Request::Picture => picture(file),
        Request::Detect { options } => targets(file, &options),
        Request::Measure { digest, u, v, options } => measure(file, digest, [u, v], &options),
        Request::Adjust { project, options } => bundle(&project, &options, answer),
        Request::Match { project, targets } => matched(&project, &targets, answer),
        Request::Experiment { name, options } => experiment(&name, &options, answer),
        Request::Pack { content, names } => pack(*content, names, files),
        Request::Unpack => unpack(file),
        Request::SamplePhoto { name, max_side } => sample_photo(&name, max_side),
    };
    match outcome {
        Ok((end, bytes)) => answer(end, bytes),
        Err(error) => answer(Answer::Failed(Box::new(error)), Vec::new()),
    }
}

fn open(file: &[u8], max_side: u32) -> Outcome {
    let (opened, small) = look_into(file, max_side)?;
    Ok((Answer::Opened(Box::new(opened)), vec![small]))
}

fn sample_photo(name: &str, max_side: u32) -> Outcome {
    let file = sample::file(name)?;
    let (opened, small) = look_into(&file, max_side)?;
    let options = DetectOptions { codes: Codes::Auto, ..DetectOptions::default() };
    let grey = decode::grey(&file, options.channel)?;
    let detection = Box::new(detect::detect(&grey.view()?, &options)?);
    Ok((Answer::SamplePhoto { opened: Box::new(opened), detection }, vec![file, small]))
}

/// Size, EXIF, small picture.
fn look_into(file: &[u8], max_side: u32) -> Result<(Opened, Vec<u8>)> {
    let size = decode::size(file)?;
    let info = exif::read(file);
    // Decoding all of it finds what is damaged before anything is built on it.
    let small = decode::picture(file, Some(max_side))?;
    let mut hasher = DefaultHasher::new();
    file.hash(&mut hasher);
    let size = [size.width, size.height];
    let opened = Opened { size, info, small: [small.width, small.height], digest: hasher.finish() };
    Ok((opened, small.rgba))
}

fn picture(file: &[u8]) -> Outcome {
    let picture = decode::picture(file, None)?;
    Ok((Answer::Picture { width: picture.width, height: picture.height }, vec![picture.rgba]))
}

fn targets(file: &[u8], options: &DetectOptions) -> Outcome {
    let grey = decode::grey(file, options.channel)?;
    Ok((Answer::Detected(Box::new(detect::detect(&grey.view()?, options)?)), Vec::new()))
}

thread_local! {
    /// The photo of the last click, decoded: the next one is most often in the same photo, and decoding takes a hundred times
    /// as long as measuring.
    static CLICKED: RefCell<Option<(u64, Channel, Grey)>> = const { RefCell::new(None) };
}

fn measure(file: &[u8], digest: u64, [u, v]: [f64; 2], options: &DetectOptions) -> Outcome {
    CLICKED.with_borrow_mut(|clicked| {
        let known = clicked.take().filter(|(of, channel, _)| (*of, *channel) == (digest, options.channel));
        let grey = match known {
            Some((.., grey)) => grey,
            None => decode::grey(file, options.channel)?,
        };
        let target = detect::measure_at(&grey.view()?, u, v, options);
        *clicked = Some((digest, options.channel, grey));
        Ok((Answer::Measured(target?.map(Box::new)), Vec::new()))
    })
}

fn bundle(project: &Project, options: &AdjustOptions, answer: Reply) -> Outcome {
    let oriented = orient(project)?;
    answer(Answer::Oriented { notes: oriented.notes }, Vec::new());
    let ready = with_what_is_oriented(oriented.project);
    let adjustment = adjust(&ready, options, &mut |iteration| {
        answer(Answer::Iteration(iteration.clone()), Vec::new());
        true
    })?;
    Ok((Answer::Adjusted { oriented: Box::new(ready), adjustment: Box::new(adjustment) }, Vec::new()))
}

/// What the notes say could not be oriented takes no part; it is not taken away.
fn with_what_is_oriented(mut project: Project) -> Project {
    for photo in &mut project.photos {
        photo.enabled &= photo.position.is_some() && photo.rotation.is_some();
    }
    let placed = project.points.iter().filter(|p| p.xyz.is_some()).map(|p| p.id.clone());
    let placed = placed.collect::<std::collections::HashSet<_>>();
    for observation in &mut project.observations {
        observation.enabled &= placed.contains(&observation.point);
    }
    project
}

fn matched(project: &Project, targets: &[PhotoTargets], answer: Reply) -> Outcome {
    let oriented = orient(project)?;
    answer(Answer::Oriented { notes: oriented.notes }, Vec::new());
    let ready = with_what_is_oriented(oriented.project);
    let options = AdjustOptions { statistics: StatisticsChoice::None, ..AdjustOptions::default() };
    let adjustment = adjust(&ready, &options, &mut |_| true)?;
    let matching = match_uncoded(&apply(&ready, &adjustment), targets, &MatchOptions::default())?;
    Ok((Answer::Matched(Box::new(matching)), Vec::new()))
}

fn experiment(name: &str, options: &ExperimentOptions, answer: Reply) -> Outcome {
    let ran = experiments::run(name, options, &mut |done, of| {
        answer(Answer::Step { done, of }, Vec::new());
        true
    })?;
    Ok((Answer::Experiment(Box::new(ran)), Vec::new()))
}

fn pack(content: Content, names: Vec<String>, files: Vec<Vec<u8>>) -> Outcome {
    let Content { project, targets, adjustment } = content;
    let photos = names.into_iter().zip(files).collect();
    let bytes = package::write(&Package { project, targets, adjustment, photos })?;
    Ok((Answer::Packed, vec![bytes]))
}

fn unpack(file: &[u8]) -> Outcome {
    let Package { project, targets, adjustment, photos } = package::read(file)?;
    let (names, bytes) = photos.into_iter().unzip();
    let content = Content { project, targets, adjustment };
    Ok((Answer::Unpacked { content: Box::new(content), names }, bytes))
}
