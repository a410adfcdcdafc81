//! What the tables hold, in the words in which `guide/outputs.md` tells of their files.

/// Stems of names of files, and what is in them.
const CAPTIONS: [(&str, &str); 28] = [
    (
        "designs",
        "one row for each design, optima included: values, natural frequencies, peak twist, largest order, shaft torque, heat, ring twist",
    ),
    (
        "absorbers",
        "one row for each absorber of every design: where it sits, its type, every parameter, heat, ring twist, the loss factor that spring and damper imply; modulus or viscosity, and strain, where its shape is given",
    ),
    ("values", "one row for each value of every design: condition, measure, value, unit, place, order, speed"),
    ("pareto", "the best absorber for each ring inertia"),
    (
        "optima",
        "one row for each optimum: value, first- and second-order conditions, agreement of starts, other local optima, designs looked at elsewhere and near it",
    ),
    (
        "sensitivities",
        "one row for each measure and parameter of every optimum: relative change, and how far (up to 50 %) the parameter may drift before a limit breaks",
    ),
    ("limits", "one row for each limit of every design: value, whether it holds, and what one per cent more of it would bring"),
    ("barred", "one row for each range of speed that a society's rule bars for a design that breaks its limit"),
    ("front", "fronts of any two measures"),
    ("duty", "twist, torque and heat of each design at the points of the duty"),
    ("life", "cycles of strain and damage of absorbers at the points of the duty"),
    ("strain", "the self-consistent strain of filled rubber at every speed, by each of the two rules"),
    ("catalogue", "every absorber of the study's catalogues, the best first"),
    ("robust", "designs within the tolerances of the study"),
    ("tolerance_band", "designs within the tolerances of the study"),
    ("heat", "temperatures of absorbers in balance of heat at every speed, stable or not"),
    ("large_twist", "steady motions of designs with an absorber whose twist is not small, stable or not"),
    ("calibration", "fitted inputs with standard errors"),
    ("margin", "cycle of stress and safety factor of the crank for each design, speed, fillet and criterion"),
    ("response", "amplitude and phase of each order, and half peak-to-peak of all together, against speed"),
    ("timing", "time and work by stage"),
    ("comparison", "published values beside computed ones"),
    ("holzer", "Holzer's tables of the first modes"),
    ("fatigue", "safety factors of every point by each criterion"),
    ("speed_accuracy", "seconds per design and error of the peak, for each response method"),
    ("sizing", "what each round of sizing found"),
    ("sizing_comparison", "printed rounds of sizing beside ours"),
    ("sizing_front", "masses of the crank against the response"),
];

/// The caption of a table by the stem of its name; that stem in words where there is none.
pub(super) fn caption(stem: &str) -> String {
    let known = CAPTIONS.iter().find(|c| c.0 == stem).map(|c| c.1.to_owned());
    let words = known.unwrap_or_else(|| stem.replace('_', " "));
    words.chars().take(1).flat_map(char::to_uppercase).chain(words.chars().skip(1)).collect()
}
