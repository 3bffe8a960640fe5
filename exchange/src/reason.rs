//! Reasons of errors of this crate: data with an English sentence, like the engine's own.

use sightline::error::Number;
use sightline::{declare_reasons, declare_words};

declare_reasons! {
    /// Why a file of another program, a list or a project file cannot be read or written.
    ExchangeReason {
        // The document
        NotADocument => "not a Sightline document: \"format\": \"sightline\" is missing";
        NewerVersion { version: String } => "the document has version {version}, but this program reads version 1: open it with a newer program";
        NoVersion => "the document has no version";
        OneFile { given: usize } => "this format consists of one file; {given} were given";

        // Texts and tables
        NotText => "not a text in UTF-8, UTF-16 or CP949: save it as a text file in UTF-8";
        MissingField { name: String, fields: usize } => "{name} is missing (fields in this line: {fields})";
        NotWhole { name: String, text: String } => "{name} is not a whole number: \"{text}\"";
        Negative { name: String, value: Number } => "{name} is negative: {value}";
        CommaAmongPoints { name: String, text: String } => "{name} has a comma, but the other numbers have a decimal point: \"{text}\" (write it without thousands separators)";
        PointAmongCommas { name: String, text: String } => "{name} has a point, but the other numbers have a decimal comma: \"{text}\" (write it without thousands separators)";
        AmbiguousNumber { name: String, text: String, decimal: String, thousands: String } => "{name} is ambiguous: \"{text}\" is {decimal} with a decimal comma and {thousands} with a thousands separator; choose the decimal sign";
        SeparatorBothWays => "the field separator may separate decimals or thousands too: save the table with semicolons or tabs, or with decimal points and a heading that names every column";
        MoreFields { fields: usize, columns: usize } => "this line has {fields} fields, but the heading names {columns} columns";
        HeadingIncomplete { name: String } => "the heading names no column {name}: name the columns id, X, Y and Z (or N, E, H)";
        HeadingTwice { name: String } => "the heading names two columns {name}";
        UnitOfCoordinates => "the heading gives a unit for the standard errors but none for the coordinates: choose the unit of the coordinates";
        GeographicIncomplete { name: String } => "the heading names latitude or longitude but no column {name}: latitude, longitude and ellipsoidal height are needed";
        GeographicOrigin => "the list contains latitudes and longitudes: give the origin of the local system (local_system), the same one for all lists that belong together";
        PlaneAndGeographic { name: String } => "latitude and longitude are chosen beside {name}: choose one of the two systems";
        AngleUnexpected { name: String, text: String } => "{name} is an angle: \"{text}\"; a length is expected";
        NotAnAngle { name: String, text: String } => "{name} is not an angle in degrees: \"{text}\"";
        AngleForm { name: String, text: String } => "{name} has another form than the other angles of the list (decimal degrees, or degrees, minutes and seconds): \"{text}\"";
        AngleDirection { name: String, text: String } => "{name} has the letter of the other axis: \"{text}\"";
        AngleOutside { name: String, text: String, limit: Number } => "{name} is outside ±{limit}°: \"{text}\"";
        ListColumns { needed: usize, columns: usize } => "a row of this list needs at least {needed} columns; this one has {columns}";
        ControlColumns { columns: usize } => "a control point needs four columns (id, X, Y, Z), but the table has {columns}";

        // The project file
        NameWithFolders => "a photo's file name must not contain folders";
        Entries { entries: usize, limit: usize } => "the archive has {entries} entries; a project file has up to {limit}";
        SameNames => "not a project file: entries of the archive have the same name";
        SharedBytes => "not a project file: entries of the archive share their bytes";
        EntryName => "the name of an entry of the archive is damaged";
        EntrySize => "this part of the project file is damaged: its size is not the stated one";
        TakesTooMuch { megabytes: u64 } => "the document would take more than {megabytes} MB of memory";
        CannotCarry { name: String } => "the identifier \"{name}\" cannot be written in this format, where it would be read as another one: rename it";
        NoProjectInside => "not a project file: the archive contains no project.json";
        DamagedEntry { message: String } => "the project file is damaged: {message}";
        Unpacks { megabytes: u64 } => "not a project file: the archive unpacks to more than {megabytes} MB";
        DamagedArchive { message: String } => "not a project file, or a damaged one ({message}): save it again with the program that made it";
        CannotPack { message: String } => "the project file cannot be written: {message}";

        // Other programs' files
        PhotoModelerCut { part: PhotoModelerPart } => "not a PhotoModeler text export, or incomplete: {part} is missing";
        NoPixels => "the picture has no pixels";
        NotDbat => "not a DBAT project: document and input are missing";
        NoColumn { column: String } => "the format has no column {column}";
        ColumnsNotNamed { file: String } => "the columns of {file} are not named";
        Numbers { name: String, count: usize, text: String } => "{name} is not {count} numbers: \"{text}\"";
        SizeNotPositive { name: String } => "{name} needs a positive width and height";
        LensModel { model: Number } => "lens model {model} distorts the ideal point: only models that correct the measured point (from 1) are supported";
        Skew => "only a skew of 0 is supported";
        CamerasNotTold { cameras: usize } => "cameras in the project: {cameras}; the photos do not name their camera";
        Filter { text: String } => "a filter is keep or remove, not \"{text}\"";
        DamagedXml { message: String } => "the XML is damaged: {message}";
        XmlTooDeep { limit: usize } => "the XML is nested deeper than {limit} elements";
        XmlEntity { name: String } => "the XML is damaged: unknown entity {name}";
        XmlOpen { name: String } => "the XML is damaged: {name} is not closed";
        XmlEmpty => "the XML is damaged: it is empty";
        DamagedYaml { message: String } => "the YAML is damaged: {message}";
        FormatUnrecognised => "the format of these files is not recognised: name it instead of \"auto\"";
        ExpectedHere { expected: String, found: String } => "expected {expected}, found \"{found}\"";
        EndsWhere { expected: String } => "the file ends where {expected} is expected";
        NoSuchCameraModel { model: String } => "camera model {model} is not supported: calibrate with a perspective model (OpenCV, Brown) in the other program, or undistort the photos there";
        PhotoSize { name: String } => "the file has no image size, and the size of the photo \"{name}\" is not known: add the photo to the project first, or give it together with the file";
        ConversionFails { model: String } => "camera model {model} cannot be fitted in this region: give the region of the picture that is used";
        ConversionTooLarge { max_px: Number } => "the camera models differ by up to {max_px} pixels: accept this with the option convert, or give the region of the picture that is used";
        RegionShape => "a region must be a polygon of at least three different points in pixels";
        CovarianceShape => "a covariance needs parameters of this camera, and a symmetric positive matrix with one row and column for each";
    }
}

declare_words! {
    /// A part of PhotoModeler's text export.
    PhotoModelerPart {
        Heading = "heading" => "heading";
        Size = "picture size" => "picture size";
        Weights = "weights" => "weights";
        Camera = "camera" => "camera";
        CameraSigmas = "camera sigmas" => "camera sigmas";
        Photo = "photo" => "photo";
        Exterior = "exterior orientation" => "exterior orientation";
        ExteriorSigmas = "sigmas of the exterior orientation" => "sigmas of the exterior orientation";
        PhotoCamera = "camera of the photo" => "camera of the photo";
        PhotoCameraSigmas = "sigmas of the camera" => "sigmas of the camera";
    }
}
