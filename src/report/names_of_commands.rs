//! The names of the files of each command.

use super::matrices::MatrixFormat;
use super::names::{CLASSIFICATION, Names, PAGE, RESULTS, UNFINISHED};
use super::run_tables::{RUN_TABLES, has_large_twist, materials};
use crate::absorber::construction::shape;
use crate::input::{FrontSpec, RETUNED, Study};

/// Whether a study has a damper by its dimensions.
fn by_dimensions(study: &Study) -> bool {
    let searched = study.optimise.iter().flat_map(|o| &o.absorbers).any(|a| a.types.iter().any(|t| shape(t).is_some()));
    let given = study.designs.iter().chain(study.catalogues.iter().flat_map(|c| &c.designs));
    searched || given.flat_map(|d| &d.absorbers).any(|m| m.absorber.law().is_some_and(|law| law.parts().is_some()))
}

impl Names {
    /// Plots of designs: those that are given, the best of catalogues, and optima.
    fn each_design(mut self, study: &Study) -> Self {
        let sold = study.catalogues.iter().flat_map(|c| &c.designs);
        let sold = sold.flat_map(|d| [d.name.clone(), format!("{}{RETUNED}", d.name)]);
        let given = study.designs.iter().map(|d| d.name.clone());
        let found = study.optimise.iter().map(|_| "optimum_*".to_owned());
        let all: Vec<String> = given.chain(sold).chain(found).collect();
        self.plots.extend(all.iter().map(|name| format!("response_{name}")));
        if by_dimensions(study) {
            self.sheets.extend(all.iter().map(|name| format!("order_{name}")));
        }
        self
    }

    /// Those of `hartog run`.
    #[doc(hidden)]
    pub fn of_run(study: &Study) -> Self {
        let asked = RUN_TABLES.iter().filter(|t| (t.asked)(study)).map(|t| t.stem);
        let mut names = Self::of("run", &[PAGE, RESULTS, UNFINISHED])
            .tables(&asked.collect::<Vec<_>>())
            .tables(&["response", "timing"])
            .tables_if(study.optimise.as_ref().is_some_and(|o| o.prove.file), &["proof_optimum_*"])
            .plots(&["designs", "campbell", "excitation"])
            .each_design(study)
            .plots_if(materials(study, &|m| m.thermal.is_some()), &["heat"])
            .plots_if(has_large_twist(study), &["large_twist"])
            .both_if(study.robust.is_some(), &["tolerance_band"])
            .both_if(study.calibrate.is_some(), &["calibration"])
            .both_if(study.fatigue.is_some(), &["margin"]);
        if study.fatigue.is_some() {
            names = names.plots(&["crank"]);
        }
        match &study.front {
            Some(FrontSpec::OverInertia(_)) => names.plots(&["pareto"]),
            Some(FrontSpec::Of { measures, .. }) => {
                let words = || measures.iter().map(|m| &m.word);
                names.plots.extend(words().flat_map(|a| words().map(move |b| format!("front_{a}_{b}"))));
                names
            }
            None => names,
        }
    }

    /// Those of `hartog report`.
    #[doc(hidden)]
    pub fn of_report(study: &Study) -> Self {
        Self::of("report", &[CLASSIFICATION])
            .tables(&["designs", "values", "absorbers", "response", "holzer", "vector_sums", "criticals", "shaft_torques"])
            .tables_if(!study.limits.is_empty(), &["limits", "barred", "rule_stresses"])
            .plots(&["campbell", "excitation"])
            .each_design(study)
    }

    /// Those of `hartog compare` of a study.
    #[doc(hidden)]
    pub fn of_comparison() -> Self {
        Self::of("compare", &[PAGE]).both(&["comparison", "calibration"]).tables(&["choices"]).plots(&["orders"])
    }

    /// Those of `hartog compare` of a sizing file.
    #[doc(hidden)]
    pub fn of_rounds() -> Self {
        Self::of("compare", &[PAGE]).tables(&["sizing_comparison", "sizing_examples"])
    }

    /// Those of `hartog chart`.
    #[doc(hidden)]
    pub fn of_chart() -> Self {
        Self::of("chart", &[PAGE]).both(&["speed_accuracy"]).plots(&["models", "growth", "stability"])
    }

    /// Those of `hartog matrices`.
    #[doc(hidden)]
    pub fn of_matrices() -> Self {
        let all: Vec<String> = MatrixFormat::files().collect();
        Self::of("matrices", &[PAGE]).with_files(all)
    }

    /// Those of `hartog curves`.
    #[doc(hidden)]
    pub fn of_curves(study: &Study) -> Self {
        let shafts: Vec<String> = study.designs.iter().map(|d| format!("shaft_torque_{}", d.name)).collect();
        let flexible = study.on_flexible();
        let (by_matrices, of_beams) = flexible.map_or((false, false), |f| (f.spec.beams().is_none(), f.spec.beams().is_some()));
        let throws = study.crank.as_ref().map_or(0, crate::crankshaft::Crank::throws);
        let designs = || std::iter::once(String::new()).chain(study.designs.iter().map(|d| format!("{}_", d.name)));
        let unknowns: Vec<String> = designs().map(|d| format!("unknowns_{d}#")).collect();
        let loads: Vec<String> = (1..=throws).flat_map(|t| designs().map(move |d| format!("throw_{t}_loads_{d}#"))).collect();
        Self::of("curves", &[PAGE])
            .both_if(of_beams, &["crank_modes_free", "journal_moments_#"])
            .tables_if(of_beams, &loads.iter().map(String::as_str).collect::<Vec<_>>())
            .both_if(flexible.is_some(), &["crank_modes", "orbits_#", "bearing_forces_#", "web_moments_#"])
            .tables_if(by_matrices, &unknowns.iter().map(String::as_str).collect::<Vec<_>>())
            .tables(&["holzer"])
            .both(&["cylinder", "forces_#", "torque_#", "kinematics_#", "pin_forces_#", "methods_#", "shafts_#", "loads_over_speed"])
            .both(&["bearings_#", "crank_loads_#", "balance", "campbell", "modes"])
            .both_if(study.fatigue.as_ref().is_some_and(|f| f.torsion_case.is_some()), &["torsion_cases_#"])
            .both(&["phase_vectors", "spectrum", "histories", "absorber_chart"])
            .both(&shafts.iter().map(String::as_str).collect::<Vec<_>>())
    }

    /// Those of `hartog fatigue`.
    #[doc(hidden)]
    pub fn of_fatigue() -> Self {
        Self::of("fatigue", &[PAGE]).both(&["fatigue", "fatigue_history", "fatigue_points"])
    }

    /// Those of `hartog fit`.
    #[doc(hidden)]
    pub fn of_fit() -> Self {
        Self::of("fit", &[PAGE]).both(&["fit"])
    }

    /// Those of `hartog size`.
    #[doc(hidden)]
    pub fn of_size() -> Self {
        Self::of("size", &[PAGE, "engine.toml", "study.toml", "pressure.csv"])
            .tables(&["sizing", "sizing_comparison"])
            .both(&["sizing_front", "sizing_forces_*", "sizing_moments_*", "sizing_kinematics_*"])
            .plots(&["drawing"])
    }
}
