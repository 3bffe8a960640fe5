//! How the engine does each task: every one is a call into it.

use std::collections::HashSet;
use std::io::{Cursor, Read, Seek};

use sightline::adjust::{adjust, apply, measured_at};
use sightline::adjustment::{AdjustOptions, Measured, StatisticsChoice, Termination};
use sightline::calibration::{
    ComparedModel, Coverage, CrossValidation, ModelConversion, compare_models, convert_camera, coverage, cross_validate,
};
use sightline::comparison::{Comparison, compare};
use sightline::decode::Packed;
use sightline::detection::{Channel, Codes, ColoursApart, DetectOptions, Detection, Target};
use sightline::error::{Error, Place, Reason, Thing};
use sightline::matching::{
    GridNaming, MatchOptions, Matching, PhotoVectors, Prediction, displaced, match_uncoded, name_grid, predict,
};
use sightline::monitoring::{self, Epoch, Monitoring};
use sightline::orient::{Note, orient};
use sightline::project::{Plan, Project};
use sightline::sensor::{self, Shot};
use sightline::tiles::{self, Pyramid};
use sightline::{Result, decode, detect, exif};
use sightline_exchange as exchange;
use sightline_exchange::displacements;
use sightline_exchange::package::{self, Held, Package};
use sightline_lab::experiments::{self, Experiment};
use sightline_lab::sample;
use sightline_plan::{self as plan, Made, Prediction as PlanPrediction, Suggested};
use sightline_protocol::{
    Adjust, Adjusted, Adjusting, BeginPlan, CompareEpochs, CompareModels, CompareResults, Content, ConvertCamera,
    CoverPhotos, CrossValidate, Detect, DisplacePhotos, DrawSheets, Drawn, Export, ExportExperiment, ExportMonitoring,
    Foreign, Given, Glance, Glanced, MakePlan, MakePlots, MakeReport, Match, Measure, MeasureColours, MeasureFeatures,
    NameGrid, Nothing, Open, Opened, Pack, PlanOf, Predict, PredictPlan, Progress, ReadForeign, ReportEpochs,
    ReportMade, RunExperiment, Sample, SampleEpochs, SamplePhoto, SamplePhotoMade, Served, Service, ShowPart,
    ShowPhoto, ShowValues, Shown, Situate, Situated, Stream, SuggestPhoto, Unpack, Unpacked, Values, WriteCamera,
    WriteNetwork, WriteSheets, Written, from_pieces, written,
};
use sightline_report::plots::{Plot, comparison, plots};
use sightline_report::sheets::{self, TargetKind};
use sightline_report::{self as report, Report};

use crate::Engine;
use crate::codecs::{shot_of, unpack};
use crate::decoded::{self, digest, with_photo};
use crate::foreign;

type Files = Vec<Given>;

impl Service<Glance> for Engine {
    fn serve(&self, task: Glance, files: Files, _: Progress<Nothing>) -> Served<Option<Glanced>> {
        let found = match files.into_iter().next() {
            Some(Given::Stream(mut stream)) => glanced(&mut stream, task.max_side),
            Some(Given::Whole(bytes)) => glanced(&mut Cursor::new(bytes), task.max_side),
            None => None,
        };
        let (glanced, rgba) = found.unzip();
        Ok((glanced, rgba.into_iter().collect()))
    }
}

impl Service<Open> for Engine {
    fn serve(&self, task: Open, files: Files, _: Progress<Nothing>) -> Served<Opened> {
        let (opened, small) = look_into(first(&files), task.max_side)?;
        Ok((opened, vec![small]))
    }
}

impl Service<ShowPhoto> for Engine {
    fn serve(&self, _: ShowPhoto, files: Files, _: Progress<Nothing>) -> Served<Pyramid> {
        Ok(tiles::pyramid(shown(first(&files))?))
    }
}

impl Service<ShowValues> for Engine {
    fn serve(&self, task: ShowValues, files: Files, _: Progress<Nothing>) -> Served<Values> {
        let read = |photo: &Shot| {
            let (place, samples) = sensor::values(photo, task.place.map(|n| n as usize));
            Ok((Values { place: place.map(|n| n as u32), samples }, Vec::new()))
        };
        with_photo(first(&files), task.digest, Channel::default(), read)
    }
}

impl Service<Detect> for Engine {
    fn serve(&self, task: Detect, files: Files, _: Progress<Nothing>) -> Served<Detection> {
        let (file, options) = (first(&files), &task.options);
        let detect = |photo: &Shot| detect::detect_shot(photo, options);
        Ok((with_photo(file, digest(file), options.channel, detect)?, Vec::new()))
    }
}

impl Service<MeasureColours> for Engine {
    fn serve(&self, task: MeasureColours, files: Files, _: Progress<Nothing>) -> Served<ColoursApart> {
        let apart = detect::colours_apart(|channel| shot_of(first(&files), channel), &task.options)?;
        Ok((apart, Vec::new()))
    }
}

impl Service<Measure> for Engine {
    fn serve(&self, task: Measure, files: Files, _: Progress<Nothing>) -> Served<Option<Target>> {
        let Measure { digest, u, v, options } = task;
        let measure = |photo: &Shot| detect::measure_in_shot(photo, u, v, &options);
        Ok((with_photo(first(&files), digest, options.channel, measure)?, Vec::new()))
    }
}

impl Service<Adjust> for Engine {
    fn serve(&self, task: Adjust, files: Files, progress: Progress<Adjusting>) -> Served<Adjusted> {
        let texts = files.iter().map(|file| if let Given::Whole(text) = file { &text[..] } else { &[] });
        let project = from_pieces(&task.project, texts)
            .map_err(|message| Error::Invalid { reason: Reason::NotJson { message }, at: Place::default() })?;
        drop(files);
        let oriented = with_what_is_oriented(&project, &mut |notes| progress(Adjusting::Oriented(notes)))?;
        let adjustment = adjust(&oriented, &task.options, &mut |iteration| {
            progress(Adjusting::Iteration(iteration.clone()));
            true
        })?;
        let (oriented, mut texts) = written(&oriented).unzip::<_, _, Vec<_>, Vec<_>>();
        let (adjustment, more) = written(&adjustment).unzip::<_, _, Vec<_>, Vec<_>>();
        texts.extend(more);
        Ok((Adjusted { oriented, adjustment }, texts))
    }
}

impl Service<ConvertCamera> for Engine {
    fn serve(&self, task: ConvertCamera, _: Files, _: Progress<Nothing>) -> Served<(Project, ModelConversion)> {
        Ok((convert_camera(&task.project, &task.camera, &task.model)?, Vec::new()))
    }
}

impl Service<CompareModels> for Engine {
    fn serve(&self, task: CompareModels, _: Files, _: Progress<Nothing>) -> Served<Vec<ComparedModel>> {
        let oriented = with_what_is_oriented(&task.project, &mut |_| {})?;
        Ok((compare_models(&oriented, &task.options)?, Vec::new()))
    }
}

impl Service<CrossValidate> for Engine {
    fn serve(&self, task: CrossValidate, _: Files, _: Progress<Nothing>) -> Served<CrossValidation> {
        let oriented = with_what_is_oriented(&task.project, &mut |_| {})?;
        Ok((cross_validate(&oriented, &task.options)?, Vec::new()))
    }
}

impl Service<CoverPhotos> for Engine {
    fn serve(&self, task: CoverPhotos, _: Files, _: Progress<Nothing>) -> Served<Coverage> {
        Ok((coverage(&task.project, Some(&task.camera))?, Vec::new()))
    }
}

impl Service<MeasureFeatures> for Engine {
    fn serve(&self, task: MeasureFeatures, _: Files, _: Progress<Nothing>) -> Served<Measured> {
        Ok((measured_at(&task.project, &task.options)?, Vec::new()))
    }
}

impl Service<NameGrid> for Engine {
    fn serve(&self, task: NameGrid, _: Files, _: Progress<Nothing>) -> Served<GridNaming> {
        Ok((name_grid(&task.project, &task.targets, &task.board, &task.options)?, Vec::new()))
    }
}

impl Service<Match> for Engine {
    fn serve(&self, task: Match, _: Files, progress: Progress<Vec<Note>>) -> Served<Matching> {
        let oriented = with_what_is_oriented(&task.project, progress)?;
        let options = AdjustOptions { statistics: StatisticsChoice::None, ..AdjustOptions::default() };
        let adjustment = adjust(&oriented, &options, &mut |_| true)?;
        let matching = match_uncoded(&apply(&oriented, &adjustment), &task.targets, &MatchOptions::default())?;
        Ok((matching, Vec::new()))
    }
}

impl Service<Situate> for Engine {
    fn serve(&self, task: Situate, _: Files, _: Progress<Nothing>) -> Served<Situated> {
        let oriented = with_what_is_oriented(&task.project, &mut |_| {})?;
        let options = AdjustOptions {
            unmodelled: task.options.unmodelled,
            target_diameter: task.options.target_diameter,
            ..AdjustOptions::default()
        };
        // Where the network does not determine an adjustment yet, its initial values serve.
        let situated = match adjust(&oriented, &options, &mut |_| true) {
            Ok(adjustment) if adjustment.termination == Termination::Converged => {
                Situated::of(apply(&oriented, &adjustment), Some(&adjustment))
            }
            _ => Situated::of(oriented, None),
        };
        Ok((situated, Vec::new()))
    }
}

impl Service<Predict> for Engine {
    fn serve(&self, task: Predict, _: Files, _: Progress<Nothing>) -> Served<Prediction> {
        let predicted = predict(&task.project, task.adjustment.as_ref(), &task.point, &task.options)?;
        Ok((predicted, Vec::new()))
    }
}

impl Service<ShowPart> for Engine {
    fn serve(&self, task: ShowPart, files: Files, _: Progress<Nothing>) -> Served<Shown> {
        let part = |photo: &Shot| {
            let picture = sensor::part(photo, [task.left as usize, task.top as usize], task.side as usize);
            Ok((Shown { width: picture.width, height: picture.height }, vec![picture.rgba]))
        };
        with_photo(first(&files), task.digest, Channel::default(), part)
    }
}

impl Service<Pack> for Engine {
    fn serve(&self, task: Pack, files: Files, _: Progress<Nothing>) -> Served<()> {
        let Content { project, targets, adjustment } = task.content;
        let files = files.into_iter().map(|file| match file {
            Given::Whole(bytes) => Box::new(Cursor::new(bytes)) as Box<dyn Stream>,
            Given::Stream(stream) => stream,
        });
        let mut photos = task.names.iter().map(String::as_str).zip(files).collect::<Vec<_>>();
        let package = Package { project, targets, adjustment, ..Package::default() };
        Ok(((), package::write_around(&package, &mut photos)?))
    }
}

impl Service<Unpack> for Engine {
    fn serve(&self, _: Unpack, files: Files, _: Progress<Nothing>) -> Served<Unpacked> {
        let (package, photos) = match files.into_iter().next() {
            Some(Given::Stream(stream)) => package::read_from(stream)?,
            Some(Given::Whole(bytes)) => package::read_from(Cursor::new(bytes))?,
            None => package::read_from(Cursor::new([]))?,
        };
        let Package { project, targets, adjustment, damaged, .. } = package;
        let (mut names, mut places, mut unpacked) = (Vec::new(), Vec::new(), Vec::new());
        for (name, held) in photos {
            names.push(name);
            places.push(match held {
                Held::At(start, size) => Some((start, size)),
                Held::Unpacked(bytes) => {
                    unpacked.push(bytes);
                    None
                }
            });
        }
        Ok((Unpacked { content: Content { project, targets, adjustment }, names, places, damaged }, unpacked))
    }
}

impl Service<Export> for Engine {
    fn serve(&self, task: Export, _: Files, _: Progress<Nothing>) -> Served<Vec<String>> {
        Ok(report::files::export(&task.format, &task.project, task.adjustment.as_ref(), false)?.into_iter().unzip())
    }
}

impl Service<ReadForeign> for Engine {
    fn serve(&self, task: ReadForeign, files: Files, _: Progress<Nothing>) -> Served<Foreign> {
        let whole = files.into_iter().filter_map(|given| match given {
            Given::Whole(bytes) => Some(bytes),
            Given::Stream(_) => None,
        });
        Ok((foreign::read(task.names.into_iter().zip(whole).collect(), task.sizes, task.convert), Vec::new()))
    }
}

impl Service<WriteCamera> for Engine {
    fn serve(&self, task: WriteCamera, _: Files, _: Progress<Nothing>) -> Served<Written> {
        let written = exchange::cameras::export(&task.format, &task.camera, &task.options)?;
        let (names, bytes) = written.files.into_iter().unzip();
        let conversions = written.conversion.into_iter().collect();
        Ok((Written { names, conversions, ignored: written.ignored }, bytes))
    }
}

impl Service<WriteNetwork> for Engine {
    fn serve(&self, task: WriteNetwork, _: Files, _: Progress<Nothing>) -> Served<Written> {
        let WriteNetwork { format, project, adjustment, convert } = task;
        let files = report::files::export(&format, &project, adjustment.as_ref(), convert)?;
        let (conversions, ignored) = exchange::stated(&files);
        // Programs look for these files by their names: they stay together in an archive.
        let name = format!("{format}.zip");
        Ok((Written { names: vec![name], conversions, ignored }, vec![package::archive(&files)?]))
    }
}

impl Service<MakeReport> for Engine {
    fn serve(&self, task: MakeReport, _: Files, _: Progress<Nothing>) -> Served<ReportMade> {
        let Report { page_style, style, body, .. } = report::report(&task.project, Some(&task.adjustment))?;
        Ok((ReportMade { page_style, style: style.to_owned(), body }, Vec::new()))
    }
}

impl Service<MakePlots> for Engine {
    fn serve(&self, task: MakePlots, _: Files, _: Progress<Nothing>) -> Served<Vec<Plot>> {
        let MakePlots { project, adjustment, before } = task;
        let mut all = plots(&project, Some(&adjustment))?;
        if let Some((old, earlier)) = before {
            let found = compare((&old, &earlier), (&project, &adjustment));
            all.extend(comparison(&project, Some(&adjustment), &found)?);
        }
        Ok((all, Vec::new()))
    }
}

impl Service<CompareResults> for Engine {
    fn serve(&self, task: CompareResults, _: Files, _: Progress<Nothing>) -> Served<Comparison> {
        Ok((compare((&task.before, &task.earlier), (&task.after, &task.later)), Vec::new()))
    }
}

impl Service<CompareEpochs> for Engine {
    fn serve(&self, task: CompareEpochs, _: Files, progress: Progress<(usize, usize)>) -> Served<Monitoring> {
        let found = monitoring::compare_epochs_watched(&task.epochs, &task.options, &mut |done, of| {
            progress((done, of));
            true
        })?;
        Ok((found, Vec::new()))
    }
}

impl Service<ExportMonitoring> for Engine {
    fn serve(&self, task: ExportMonitoring, _: Files, _: Progress<Nothing>) -> Served<()> {
        Ok(((), vec![displacements::write(&task.found, &task.format, task.pair, task.factor)?]))
    }
}

impl Service<DisplacePhotos> for Engine {
    fn serve(&self, task: DisplacePhotos, _: Files, _: Progress<Nothing>) -> Served<Vec<PhotoVectors>> {
        Ok((displaced(&task.project, &task.adjustment, &task.pair, task.factor)?, Vec::new()))
    }
}

impl Service<ReportEpochs> for Engine {
    fn serve(&self, task: ReportEpochs, _: Files, _: Progress<Nothing>) -> Served<ReportMade> {
        let Report { page_style, style, body, .. } = report::epochs::report(&task.found, &task.options, &task.settings);
        Ok((ReportMade { page_style, style: style.to_owned(), body }, Vec::new()))
    }
}

impl Service<SampleEpochs> for Engine {
    fn serve(&self, _: SampleEpochs, _: Files, progress: Progress<(usize, usize)>) -> Served<Vec<Epoch>> {
        let epochs = sample::epochs::epochs(&mut |done, of| {
            progress((done, of));
            true
        })?;
        Ok((epochs, Vec::new()))
    }
}

impl Service<RunExperiment> for Engine {
    fn serve(&self, task: RunExperiment, _: Files, progress: Progress<(usize, usize)>) -> Served<Experiment> {
        let ran = experiments::run(&task.name, &task.options, &mut |done, of| {
            progress((done, of));
            true
        })?;
        Ok((ran, Vec::new()))
    }
}

impl Service<ExportExperiment> for Engine {
    fn serve(&self, task: ExportExperiment, _: Files, _: Progress<Nothing>) -> Served<()> {
        let mut files = experiments::csv(&task.experiment);
        let bytes = match task.only {
            Some(name) => files.remove(&name).into_iter().collect(),
            None => vec![package::archive(&files)?],
        };
        Ok(((), bytes))
    }
}

impl Service<BeginPlan> for Engine {
    fn serve(&self, task: BeginPlan, _: Files, _: Progress<Nothing>) -> Served<Plan> {
        let made = match task.of {
            PlanOf::Project(project) => plan::from_project(&project),
            PlanOf::Example(name) => experiments::plan(&name).ok_or_else(|| Error::Unknown {
                kind: Thing::Experiment,
                name,
                at: Place::default(),
            })?,
        };
        Ok((made, Vec::new()))
    }
}

impl Service<PredictPlan> for Engine {
    fn serve(&self, task: PredictPlan, _: Files, _: Progress<Nothing>) -> Served<Vec<PlanPrediction>> {
        let mut all = vec![plan::predict(&task.plan)?];
        let others: Vec<_> = task.plan.variants.iter().map(|variant| variant.stations.clone()).collect();
        all.extend(plan::compare(&task.plan, &others)?);
        Ok((all, Vec::new()))
    }
}

impl Service<SuggestPhoto> for Engine {
    fn serve(&self, task: SuggestPhoto, _: Files, progress: Progress<(usize, usize)>) -> Served<Vec<Suggested>> {
        let found = plan::suggest(&task.plan, &task.criterion, &mut |done, of| {
            if done.is_multiple_of(20) {
                progress((done, of));
            }
            true
        })?;
        Ok((found, Vec::new()))
    }
}

impl Service<MakePlan> for Engine {
    fn serve(&self, task: MakePlan, _: Files, progress: Progress<(usize, usize)>) -> Served<Made> {
        let made = plan::make(&task.plan, &task.options, &mut |done, of| {
            progress((done, of));
            true
        })?;
        Ok((made, Vec::new()))
    }
}

/// More sheets than these are not shown small.
const MOST_SKETCHES: usize = 60;

impl Service<DrawSheets> for Engine {
    fn serve(&self, task: DrawSheets, _: Files, _: Progress<Nothing>) -> Served<Drawn> {
        let drawn = sheets::target_sheets(&task.options)?;
        let of = |kind| drawn.targets.iter().filter(|target| target.kind == kind).count();
        let shown = task.sheet.min(drawn.pages.len().saturating_sub(1));
        let answer = Drawn {
            titles: drawn.pages.iter().map(|page| page.title.clone()).collect(),
            sketches: (0..drawn.pages.len().min(MOST_SKETCHES)).filter_map(|k| drawn.sketch(k)).collect(),
            svg: drawn.svg(shown).unwrap_or_default(),
            codes: of(TargetKind::Code),
            dots: of(TargetKind::Dot),
            bars: drawn.bars.len(),
            counts: sheets::counts(task.options.family),
            least_distance: drawn.least_distance,
            scale: drawn.scale,
            scale_sigma: drawn.scale_sigma,
            diameter: drawn.diameter,
        };
        Ok((answer, Vec::new()))
    }
}

impl Service<WriteSheets> for Engine {
    fn serve(&self, task: WriteSheets, _: Files, _: Progress<Nothing>) -> Served<Vec<String>> {
        let drawn = sheets::target_sheets(&task.options)?;
        Ok(match task.svg {
            _ if task.pdf => (vec!["targets.pdf".to_owned()], vec![drawn.pdf()]),
            Some(sheet) => {
                let svg = drawn.svg(sheet).map(String::into_bytes);
                (vec![format!("targets-{}.svg", sheet + 1)], svg.into_iter().collect())
            }
            None => drawn.files().into_iter().unzip(),
        })
    }
}

impl Service<Sample> for Engine {
    fn serve(&self, _: Sample, _: Files, _: Progress<Nothing>) -> Served<Project> {
        Ok((sample::project()?, Vec::new()))
    }
}

impl Service<SamplePhoto> for Engine {
    fn serve(&self, task: SamplePhoto, _: Files, _: Progress<Nothing>) -> Served<SamplePhotoMade> {
        let file = sample::file(&task.name)?;
        let (opened, small) = look_into(&file, task.max_side)?;
        let options = DetectOptions { codes: Codes::Auto, ..DetectOptions::default() };
        let detect = |photo: &Shot| detect::detect_shot(photo, &options);
        let detection = with_photo(&file, opened.digest, options.channel, detect)?;
        Ok((SamplePhotoMade { opened, detection }, vec![file, small]))
    }
}

/// The bytes of the only file.
fn first(files: &[Given]) -> &[u8] {
    if let Some(Given::Whole(bytes)) = files.first() { bytes } else { &[] }
}

/// Size, EXIF, small picture, from one decoding; the photo is kept for what comes next.
fn look_into(file: &[u8], max_side: u32) -> Result<(Opened, Vec<u8>)> {
    let channel = Channel::default();
    if let Some(format) = decode::packed(file) {
        return look_into_packed(file, format, max_side);
    }
    // Decoding all of it finds what is damaged before anything is built on it.
    let (photo, small) = decode::photo_and_picture(file, channel, max_side)?;
    let size = [photo.grey.width, photo.grey.height].map(|side| side as u32);
    let digest = digest(file);
    decoded::keep(digest, channel, Shot::Photo(photo));
    let opened = Opened {
        size,
        info: exif::read(file),
        small: [small.width, small.height],
        digest,
        sha256: report::sha256(file),
    };
    Ok((opened, small.rgba))
}

/// The same for a format whose decoder is not in the engine. Of a RAW the picture that its camera embedded is taken, so that
/// many of them are there at once; its samples are decoded when they are measured.
fn look_into_packed(file: &[u8], format: Packed, max_side: u32) -> Result<(Opened, Vec<u8>)> {
    let channel = Channel::default();
    let digest = digest(file);
    let mut unpacked = unpack(file, format, channel, !format.is_raw(), max_side)?;
    if format.is_raw() && unpacked.small.is_empty() {
        unpacked = unpack(file, format, channel, true, 0)?;
    }
    let mut small = (unpacked.header.small, std::mem::take(&mut unpacked.small));
    let (size, info) = ([unpacked.header.width, unpacked.header.height], unpacked.header.info.clone());
    if small.1.is_empty() || !format.is_raw() {
        let shot = unpacked.into_shot()?;
        if small.1.is_empty() {
            let picture = sensor::picture(&shot, max_side);
            small = ([picture.width, picture.height], picture.rgba);
        }
        decoded::keep(digest, channel, shot);
    }
    let sha256 = report::sha256(file);
    Ok((Opened { size, info, small: small.0, digest, sha256 }, small.1))
}

/// The picture that is embedded in a file, in RGBA. That of a HEIC is packed as the photo is, and the file is read for it.
fn glanced(file: &mut (impl Read + Seek), max_side: u32) -> Option<(Glanced, Vec<u8>)> {
    if let Some(found) = decode::embedded(file, max_side) {
        let small = [found.picture.width, found.picture.height];
        return Some((Glanced { small, orientation: found.orientation }, found.picture.rgba));
    }
    file.rewind().ok()?;
    let mut bytes = Vec::new();
    file.by_ref().take(HEAD).read_to_end(&mut bytes).ok()?;
    let format = decode::packed(&bytes).filter(|format| !format.is_raw())?;
    // without one the whole picture would be decoded, which is as well done once
    if !bytes.windows(THUMBNAIL.len()).any(|kind| kind == THUMBNAIL) {
        return None;
    }
    file.take(LARGEST - HEAD).read_to_end(&mut bytes).ok()?;
    let found = unpack(&bytes, format, Channel::default(), false, max_side).ok()?;
    Some((Glanced { small: found.header.small, orientation: found.header.info.orientation }, found.small))
}

/// Bytes of the header of a HEIC file.
const HEAD: u64 = 1 << 16;
/// Bytes that are read of one: phones write a few million, and what lies beyond is found damaged.
const LARGEST: u64 = 1 << 26;
/// The name there of what refers to a picture as its thumbnail.
const THUMBNAIL: &[u8] = b"thmb";

/// Longest side of the picture that is shown of a sensor's samples.
const SHOWN_SIDE: u32 = 4096;

/// A photo for the screen. Of a RAW its own samples are shown: what the camera embedded is cropped and straightened.
fn shown(file: &[u8]) -> Result<decode::Picture> {
    let channel = Channel::default();
    match decode::packed(file) {
        None => decode::picture(file, None),
        Some(format) if format.is_raw() => {
            with_photo(file, digest(file), channel, |shot| Ok(sensor::picture(shot, SHOWN_SIDE)))
        }
        Some(format) => {
            let unpacked = unpack(file, format, channel, false, u32::MAX)?;
            let [width, height] = unpacked.header.small;
            Ok(decode::Picture { width, height, rgba: unpacked.small })
        }
    }
}

/// Result of the orientation as input of the adjustment: photos and points that could not be oriented are not used, but not removed either.
pub fn with_what_is_oriented(project: &Project, tell: &mut dyn FnMut(Vec<Note>)) -> Result<Project> {
    let oriented = orient(project)?;
    tell(oriented.notes);
    let mut project = oriented.project;
    for photo in &mut project.photos {
        photo.enabled &= photo.position.is_some() && photo.rotation.is_some();
    }
    let placed = project.points.iter().filter(|p| p.xyz.is_some()).map(|p| p.id.clone());
    let placed = placed.collect::<HashSet<_>>();
    for observation in &mut project.observations {
        observation.enabled &= placed.contains(&observation.point);
    }
    Ok(project)
}
