//! The decisions of a plan: the choice, its reason, and the effect of the next cheaper choice.

use super::accuracy::Accuracy;
use super::choice::{Candidate, cheapest};
use super::decision::{Cheaper, Decision, decibels};
use super::events::{Events, ROWS};
use octray_core::features;
use octray_prepare::PixelsPerRay;
use octray_prepare::TreeKind;
use octray_render::counts::thousands;

/// Decides the number of bounces; `less` returns the relative change of the plan's instructions with other events.
pub(super) fn bounces(accuracy: &Accuracy, less: impl Fn(&Events) -> Option<f64>) -> Decision {
    Decision {
        about: "bounces",
        chosen: accuracy.depth.to_string(),
        why: match &accuracy.unexplored {
            None => "with more, no pixel changes by one level".into(),
            Some(unexplored) => {
                format!("the fewest with the deepest picture explored; {unexplored}")
            }
        },
        cheaper: (accuracy.shallower.as_ref()).map(|(events, psnr)| Cheaper {
            choice: (accuracy.depth - 1).to_string(),
            psnr: Some(*psnr),
            instructions: less(events),
            ..Cheaper::default()
        }),
    }
}

/// Decides how many pixels one ray colours.
pub(super) fn pixels_per_ray(
    accuracy: &Accuracy,
    less: impl Fn(&Events) -> Option<f64>,
) -> Decision {
    let (events, psnr) = &accuracy.coarse;
    let four = accuracy.pixels_per_ray == PixelsPerRay::Four;
    Decision {
        about: "pixels per ray",
        chosen: accuracy.pixels_per_ray.number().to_string(),
        why: match four {
            true => format!(
                "even so {}",
                decibels(Some(*psnr).filter(|psnr| psnr.is_finite()))
            ),
            false if *psnr < accuracy.min_psnr => "the picture has too much detail for 4".into(),
            false => "with 4 no numbers come close enough".into(),
        },
        cheaper: (!four).then(|| Cheaper {
            choice: "4".into(),
            psnr: Some(*psnr),
            instructions: less(events),
            ..Cheaper::default()
        }),
    }
}

/// Decides the arithmetic.
pub(super) fn numbers(
    accuracy: &Accuracy,
    candidates: &[Candidate],
    chosen: &Candidate,
) -> Decision {
    let format = chosen.plan.format;
    let tried = accuracy.tried.iter().find(|tried| tried.format == format);
    let psnr = decibels(tried.and_then(|tried| tried.psnr));
    let other = (candidates.iter()).filter(|other| other.plan.format != format);
    let other = cheapest(other).map_or(String::new(), |other| {
        let name = other.plan.format.name();
        let cheaper = Cheaper::candidate(name.into(), other, chosen);
        format!("; {}", cheaper.text())
    });
    let scale = chosen.scale;
    let why = match tried.and_then(|tried| tried.fraction_bits) {
        Some(fraction) => {
            let (integer, largest) = (accuracy.integer_bits, &accuracy.largest);
            let bits = 1 + integer + fraction;
            format!(
                "{psnr} with {fraction} fraction bits; {integer} before the point, as {} can reach {:.3}; \
                 with the sign {bits} bits; positions take all 32, scaled by 2^{scale}{other}",
                largest.what, largest.value
            )
        }
        None => format!("{psnr}; scaled by 2^{scale}{other}"),
    };
    let narrower =
        (accuracy.tried.iter()).find(|tried| tried.fraction_bits.is_some() && !tried.does);
    Decision {
        about: "numbers",
        chosen: format.name().into(),
        why,
        cheaper: narrower.map(|tried| Cheaper {
            choice: match &tried.too_fine {
                Some(why) => why.clone(),
                None => tried.format.name().into(),
            },
            psnr: Some(tried.psnr.unwrap_or(f64::INFINITY)),
            ..Cheaper::default()
        }),
    }
}

/// Decides the tree.
pub(super) fn tree(candidates: &[Candidate], chosen: &Candidate) -> Decision {
    let name = |candidate: &Candidate| match candidate.plan.tree {
        None => "none".into(),
        Some(grown) => {
            let (leaf_size, depth) = (grown.leaf_size, grown.depth);
            let name = TreeKind::CompactBvh8.name();
            format!("{name}, leaf size {leaf_size}, depth {depth}")
        }
    };
    let work = |candidate: &Candidate| {
        let [steps, tests] = candidate.events.per_ray();
        match candidate.plan.tree {
            None => format!("{tests:.2} tests per ray"),
            _ => format!(
                "{steps:.2} steps and {tests:.2} tests per ray, {} nodes",
                candidate.nodes
            ),
        }
    };
    let alike = || {
        candidates
            .iter()
            .filter(|c| c.plan.format == chosen.plan.format)
    };
    let is_none = |c: &&Candidate| c.plan.tree.is_none();
    let versus = match chosen.plan.tree {
        None => cheapest(alike().filter(|c| !is_none(c))),
        _ => alike().find(is_none),
    };
    let versus = versus.map_or(String::new(), |other| {
        let more = 100.0 * (other.cost.instructions / chosen.cost.instructions - 1.0);
        format!(
            "; {} has {}, {more:+.1} % instructions",
            name(other),
            work(other)
        )
    });
    let smaller = alike().filter(|other| other.cost.flash() < chosen.cost.flash());
    Decision {
        about: "tree",
        chosen: name(chosen),
        why: work(chosen) + &versus,
        cheaper: (smaller.max_by_key(|other| other.cost.flash()))
            .map(|other| Cheaper::candidate(name(other), other, chosen)),
    }
}

/// Decides the capacities of queue and stacks.
pub(super) fn capacities(chosen: &Candidate) -> Decision {
    let lent = &chosen.cost.lent;
    let rays = match chosen.plan.rays {
        1 => "1 ray".into(),
        n => format!("{n} rays"),
    };
    Decision {
        about: "capacities",
        chosen: format!("{rays} waiting, {} words of tree", chosen.baked.words),
        why: format!(
            "as many as ever wait; bytes of RAM: strip of {} rows {}, rays {}, walk of the tree {}, shadow cache {}",
            ROWS,
            thousands(lent.strip as u64),
            lent.rays,
            lent.nodes,
            lent.shadow_cache,
        ),
        cheaper: None,
    }
}

/// Describes the linked code, with the weights of its parts.
pub(super) fn code(chosen: &Candidate, weights: &[f64]) -> Decision {
    let has = |what| features::contains(chosen.baked.features, what);
    let names = |wanted: bool| {
        let names = features::NAMES
            .iter()
            .filter(|(_, what)| has(*what) == wanted);
        let names: Vec<_> = names.map(|(name, _)| name.to_lowercase()).collect();
        if names.is_empty() {
            "nothing".into()
        } else {
            names.join(", ")
        }
    };
    // The first two are the constant part and the tree's.
    let absent = features::NAMES
        .iter()
        .zip(&weights[2..])
        .filter(|((_, what), _)| !has(*what));
    let saved: f64 = absent.map(|(_, bytes)| bytes).sum();
    Decision {
        about: "code",
        chosen: names(true),
        why: format!(
            "left out, about {} bytes: {}",
            thousands(saved.round() as u64),
            names(false)
        ),
        cheaper: None,
    }
}
