//! The presets of the thesis against what it prints, which `data/thesis-figures.json` has typed from it.
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::field_test;
use common::wood_ear::run;
use rock_field::params::wood_ear::{Collisions, PARAMS, PRESETS, ParamSpec, Params, Scope, TEXTS, preset};
use rock_field::validate::crossing_pairs;
use rock_field::wood_ear::{Individual, bowl, deform, drying};
use serde_json::Value;

fn printed() -> Value {
    serde_json::from_str(include_str!("data/thesis-figures.json")).unwrap()
}

/// The colony's row, not a base's.
fn row(key: &str) -> &'static ParamSpec {
    PARAMS.iter().find(|spec| spec.key == key && matches!(spec.scope, Scope::Field(..))).unwrap()
}

fn value(params: &Params, key: &str) -> f64 {
    let Scope::Field(get, _) = row(key).scope else { panic!("{key}") };
    get(params)
}

fn check_values(name: &str, params: &Params, values: &Value) {
    for (key, printed) in values.as_object().unwrap() {
        assert_eq!(value(params, key), printed.as_f64().unwrap(), "{key} of {name}");
    }
}

field_test! {
    fn every_figure_of_the_thesis_has_a_preset_with_the_values_it_prints() {
        let printed = printed();
        let figures = printed["figures"].as_object().unwrap();
        for (figure, of) in figures {
            let name = format!("thesis-fig{}", figure.replace('.', "-"));
            let params = preset(&name).unwrap_or_else(|| panic!("no preset {name}")).params();
            check_values(&name, &params, &of["values"]);
            assert_eq!([params.rings, params.meridians].map(u64::from), ["rings", "meridians"].map(|key| printed[key].as_u64().unwrap()));
            let (is_dried, is_wrinkled) = (params.moisture < 100.0, params.wrinkles > 0.0);
            let expected = match of["stage"].as_str().unwrap() {
                // Right after generation: nothing has dried, wrinkled or been moved.
                "generated" | "pair before" => (false, false, Some(Collisions::Off)),
                "pair after" => (false, false, Some(Collisions::Thesis)),
                "dried" => (true, false, None),
                "wrinkled" => (false, true, None),
                _ => (true, true, Some(Collisions::Thesis)),
            };
            assert_eq!((is_dried, is_wrinkled), (expected.0, expected.1), "{name}");
            assert!(expected.2.is_none_or(|rule| rule == params.collisions), "{name}: {:?}", params.collisions);
            assert_eq!([params.droop, params.thickness, params.foot, params.per_individual], [0.0; 4], "{name}");
            assert!(!params.clear_log, "{name}");
        }
        let named = PRESETS.iter().filter(|preset| preset.name.starts_with("thesis-fig")).count();
        assert_eq!(named, figures.len());
        // "Dry" and "wet" without a number: on either side of the default.
        let moisture = |name: &str| preset(name).unwrap().params().moisture;
        assert!(moisture("thesis-fig4-10") < 50.0 && moisture("thesis-fig4-11") > 50.0);
    }
}

field_test! {
    fn the_sliders_and_the_table_of_times_are_the_thesis_s() {
        let printed = printed();
        for (key, slider) in printed["sliders"].as_object().unwrap() {
            let spec = row(key);
            let ours = [spec.range.min, spec.range.default, spec.range.max];
            assert_eq!(ours, ["min", "default", "max"].map(|bound| slider[bound].as_f64().unwrap()), "{key}");
            let text = TEXTS.iter().zip(PARAMS).find(|(_, of)| std::ptr::eq(*of, spec)).unwrap().0;
            assert_eq!(text.label[1], printed["labels"][key].as_str().unwrap());
        }
        for (name, values) in printed["timed"].as_object().unwrap() {
            check_values(name, &preset(name).unwrap().params(), values);
        }
    }
}

field_test! {
    fn the_pair_crosses_before_the_collision_and_not_after_it() {
        let [before, after] = ["thesis-fig4-8", "thesis-fig4-9"].map(|name| preset(name).unwrap().params());
        assert_eq!(Params { collisions: Collisions::Thesis, ..before.clone() }, after);
        let [before, after] = [before, after].map(|params| run(&params));
        assert_eq!(before.generator.mesh().individuals(), 2);
        assert_eq!(crossing_pairs(before.generator.mesh()).len(), 1);
        assert_eq!(crossing_pairs(after.generator.mesh()).len(), 0);
        assert_eq!(after.preview, before.generator.mesh().positions);
        // Both have given way, and are still bowls.
        let kept = after.generator.stats().kept_p10;
        assert!((0.4..0.99).contains(&kept), "{kept}");
    }
}

field_test! {
    fn the_noise_of_drying_reaches_0_8_to_0_95_where_one_meridian_in_twenty_is_above_and_few_are_cut_off() {
        let mut all = Vec::new();
        let unit = bowl(10, 30);
        for seed in 0..40 {
            let params = Params { seed, ..Params::with_defaults() };
            for vertex in 0..250 {
                all.extend(drying(&params, vertex, &unit).iter().map(|n| n.abs()));
            }
        }
        all.sort_by(f64::total_cmp);
        let at = |share: f64| all[(share * all.len() as f64) as usize];
        let cut = all.iter().filter(|n| **n >= 1.0).count() as f64 / all.len() as f64;
        assert!((0.8..=0.95).contains(&at(0.95)), "{}", at(0.95));
        assert!(cut < 0.025, "{cut} of the meridians are cut off");
    }
}

field_test! {
    fn a_dry_rim_shrinks_by_its_noise_and_seldom_to_the_guard() {
        let params = Params { moisture: 0.0, wrinkles: 0.0, ..Params::with_defaults() };
        let unit = bowl(10, 30);
        let (mut spikes, mut rims) = (0, 0);
        for vertex in 0..1000 {
            let individual = Individual { vertex, base: 0, foot: glam::DVec3::ZERO, axes: [glam::DVec3::X, glam::DVec3::Y, glam::DVec3::Z] };
            let sheet = deform(&params, &individual, &unit);
            for (p, q) in sheet.points[270..].iter().zip(&unit[270..]) {
                rims += 1;
                spikes += usize::from(p.length() < 0.1001 * q.length());
            }
        }
        assert!(spikes * 25 < rims, "{spikes} of {rims}");
    }
}
