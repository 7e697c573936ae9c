//! `modelDescription.xml`, and the description of sources that FMI 3.0 requires beside it.
//!
//! Versions of the Functional Mock-up Interface.
//!
//! `documentation/index.html`: the contents of the unit for readers.

use abbe_spec::Spec;

use super::xml::{Element, escaped};
use super::{CORRECTION, Causality, Variable, Variables, definitions};

/// Returns `modelDescription.xml`.
pub(super) fn model(spec: &Spec, fmi: Fmi, variables: &Variables, token: &str, sources: &[String]) -> String {
    let (version, token_name) = match fmi {
        Fmi::Two => ("2.0", "guid"),
        Fmi::Three => ("3.0", "instantiationToken"),
    };
    let root = Element::new("fmiModelDescription")
        .with("fmiVersion", version)
        .with("modelName", &spec.name)
        .with(token_name, token)
        .with("description", &spec.title)
        .with("generationTool", format!("abbe {}", env!("CARGO_PKG_VERSION")))
        .with("variableNamingConvention", "structured");
    let root = match fmi {
        Fmi::Two => root.with("numberOfEventIndicators", 0),
        Fmi::Three => root,
    };
    let units = variables.list.iter().filter_map(|variable| variable.unit.as_ref());
    let mut described: Vec<Element> =
        variables.list.iter().enumerate().map(|(k, variable)| real(fmi, variable, k)).collect();
    described.extend(variables.corrected.then(|| correction(fmi, variables.list.len())));
    root.containing(interfaces(spec, fmi, sources))
        .containing([
            definitions(units),
            Element::new("ModelVariables").containing(described),
            structure(fmi, variables),
        ])
        .document()
}

/// Returns `buildDescription.xml`.
pub(super) fn build(spec: &Spec, sources: &[String]) -> String {
    let files = sources.iter().map(|file| Element::new("SourceFile").with("name", file));
    let set = Element::new("SourceFileSet").with("language", "C99").containing(files);
    let configuration = Element::new("BuildConfiguration").with("modelIdentifier", &spec.name);
    Element::new("fmiBuildDescription")
        .with("fmiVersion", "3.0")
        .containing([configuration.containing([set])])
        .document()
}

/// Returns the elements for model exchange and co-simulation.
fn interfaces(spec: &Spec, fmi: Fmi, sources: &[String]) -> [Element; 2] {
    let exchange = Element::new("ModelExchange").with("modelIdentifier", &spec.name);
    let co_simulation = Element::new("CoSimulation")
        .with("modelIdentifier", &spec.name)
        .with("canHandleVariableCommunicationStepSize", true);
    match fmi {
        Fmi::Three => [exchange, co_simulation],
        Fmi::Two => {
            let files = sources.iter().map(|file| Element::new("File").with("name", file));
            let files = Element::new("SourceFiles").containing(files);
            let exchange = exchange.with("completedIntegratorStepNotNeeded", true);
            [exchange, co_simulation].map(|interface| interface.containing([files.clone()]))
        }
    }
}

/// Returns the element of a real variable.
fn real(fmi: Fmi, variable: &Variable, reference: usize) -> Element {
    let (causality, variability) = match variable.causality {
        Causality::Independent => ("independent", "continuous"),
        Causality::Input => ("input", "continuous"),
        Causality::Parameter => ("parameter", "tunable"),
        Causality::Output => ("output", "continuous"),
    };
    let number = |value: f64| value.is_finite().then(|| format!("{value:?}"));
    let [lower, upper] = variable.range;
    let measured = |element: Element| {
        element
            .with_some("unit", variable.unit.as_ref().map(|unit| &unit.name))
            .with_some("start", variable.start.and_then(number))
            .with_some("min", number(lower))
            .with_some("max", number(upper))
    };
    let described = |name| {
        let some = Some(&variable.description).filter(|text| !text.is_empty());
        Element::new(name)
            .with("name", &variable.name)
            .with("valueReference", reference)
            .with_some("description", some)
            .with("causality", causality)
            .with("variability", variability)
    };
    match fmi {
        Fmi::Two => described("ScalarVariable").containing([measured(Element::new("Real"))]),
        Fmi::Three => measured(described("Float64")),
    }
}

/// Returns the element of the status of corrected commands.
fn correction(fmi: Fmi, reference: usize) -> Element {
    let described = |name| {
        Element::new(name)
            .with("name", CORRECTION.0)
            .with("valueReference", reference)
            .with("description", CORRECTION.1)
            .with("causality", "output")
            .with("variability", "discrete")
    };
    match fmi {
        Fmi::Two => described("ScalarVariable").containing([Element::new("Integer")]),
        Fmi::Three => described("Int32"),
    }
}

/// Returns the list of outputs, each of which may depend on all inputs.
fn structure(fmi: Fmi, variables: &Variables) -> Element {
    let count = variables.list.len() + usize::from(variables.corrected);
    let each = |name, attribute, first: usize| {
        (variables.outputs..count).map(move |k| Element::new(name).with(attribute, k + first))
    };
    let structure = Element::new("ModelStructure");
    match fmi {
        // Indices of FMI 2.0 start at 1.
        Fmi::Two => structure.containing([
            Element::new("Outputs").containing(each("Unknown", "index", 1)),
            Element::new("InitialUnknowns").containing(each("Unknown", "index", 1)),
        ]),
        Fmi::Three => structure.containing(each("Output", "valueReference", 0)).containing(each(
            "InitialUnknown",
            "valueReference",
            0,
        )),
    }
}

/// A version of the Functional Mock-up Interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fmi {
    /// Version 2.0.
    Two,
    /// Version 3.0.
    Three,
}

impl Fmi {
    /// Every version.
    pub const ALL: [Self; 2] = [Self::Two, Self::Three];

    /// Returns the name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Two => "2",
            Self::Three => "3",
        }
    }

    /// Returns the name and text of the C source with its functions.
    pub(super) fn source(self) -> (&'static str, &'static str) {
        match self {
            Self::Two => ("fmi-2.c", include_str!("fmi-2.c")),
            Self::Three => ("fmi-3.c", include_str!("fmi-3.c")),
        }
    }
}

/// Returns the page.
pub(super) fn page(spec: &Spec, fmi: Fmi, variables: &Variables) -> String {
    let title = escaped(&spec.title);
    let texts = [spec.description.as_str(), spec.reference.as_str()];
    let texts = texts.into_iter().filter(|text| !text.is_empty());
    let texts: String = texts.map(|text| format!("<p>{}</p>\n", escaped(text))).collect();
    let row = |name: &str, unit: &str, what: &str| {
        let cells = [name, unit, what].map(|cell| format!("<td>{}</td>", escaped(cell)));
        format!("<tr>{}</tr>\n", cells.concat())
    };
    let mut rows: String = variables
        .list
        .iter()
        .map(|variable| {
            let unit = variable.unit.as_ref().map_or("", |unit| &unit.name);
            row(&variable.name, unit, &variable.description)
        })
        .collect();
    if variables.corrected {
        rows.push_str(&row(CORRECTION.0, "", CORRECTION.1));
    }
    let (version, name) = (env!("CARGO_PKG_VERSION"), &spec.name);
    let source = fmi.source().0;
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><title>{title}</title></head>\n<body>\n\
         <h1>{title}</h1>\n{texts}\
         <p>Generated by abbe {version} from {file} (SHA-256 {hash}). Inputs are the joint variables q and the inputs u; \
         parameters are the structural parameters s and the magnitude of each repeatable source. Outputs depend on their \
         current values only; there are no states. In co-simulation, inputs are constant during a step.</p>\n\
         <p>To compile it, use sources/{name}.c and sources/{source} (C99) and link the math library.</p>\n\
         <table>\n<tr><th>variable</th><th>unit</th><th>description</th></tr>\n{rows}</table>\n</body>\n</html>\n",
        file = escaped(&spec.file),
        hash = spec.hash,
    )
}
