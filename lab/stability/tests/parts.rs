//! The parts, each for itself. They are no unit tests: those would compile every method in every arithmetic once more.

mod exact {
    use octray_stability::exact::{angle, exact, exact3, near, root};

    #[test]
    fn sums_of_products_are_exact() {
        let (big, small) = (exact(1e15), exact(1e-15));
        let difference = (&big + &small) * (&big - &small) - &big * &big;
        assert_eq!(difference, -(&small * &small));
    }

    #[test]
    fn roots_and_quotients_have_many_digits() {
        let two = exact(2.0);
        let rest = root(&two) * root(&two) - &two;
        assert!(near(&rest).abs() < 1e-150);
        let third = exact(1.0) / exact(3.0);
        assert!(near(&(third * exact(3.0) - exact(1.0))).abs() < 1e-150);
    }

    #[test]
    fn angles_are_precise_however_small() {
        let a = exact3([1.0, 0.0, 0.0]);
        let b = exact3([1.0, 1e-30, 0.0]);
        assert!((angle(&a, &b) - 1e-30).abs() < 1e-44);
        assert_eq!(angle(&a, &exact3([0.0; 3])), core::f64::consts::PI);
    }
}

mod number {
    use octray_core::quantize::Quantize;
    use octray_core::scalar::{Fixed, Fixed64};
    use octray_prepare::saturation::PerThread;
    use octray_stability::exact::exact;
    use octray_stability::number::{Number, counted, span};

    #[test]
    fn the_long_fixed_format_is_exact() {
        let x = Fixed64::<PerThread>::from_bits((1 << 62) + 1);
        let expected = exact((1u64 << 30) as f64) + exact(2f64.powi(-32));
        assert_eq!(x.exact(), expected);
        assert_eq!((-x).exact(), -expected);
    }

    #[test]
    fn a_scene_of_size_span_fits() {
        fn fits<S: Number>() {
            let room = S::MAX.to_f64() / 1.5;
            assert!(span::<S>() <= room && span::<S>() > room / 2.0);
        }
        fits::<Fixed<28, PerThread>>();
        fits::<Fixed<8, PerThread>>();
        fits::<Fixed64<PerThread>>();
    }

    #[test]
    fn saturations_are_counted() {
        let large = Fixed::<16, PerThread>::from_f64(30_000.0);
        assert_eq!(counted(|| large + large).1, 1);
        assert_eq!(counted(|| large - large).1, 0);
    }
}

mod state {
    use octray_stability::state::{Cause, ErrorStats, State, StateLimits, limit};

    const LIMITS: StateLimits = StateLimits {
        wrong: Some(limit(0.0, 0.1)),
        error: Some(limit(0.01, 0.25)),
        ..StateLimits::NONE
    };

    #[test]
    fn the_worst_measure_counts() {
        let mut errors = ErrorStats::default();
        assert!(errors.decide(true, true));
        errors.err(0.01);
        assert_eq!(LIMITS.judge(&errors), (State::Holds, Cause::None));
        errors.err(-0.02);
        assert_eq!(LIMITS.judge(&errors), (State::Degrades, Cause::Error));
        assert!(!errors.decide(true, false));
        assert_eq!(LIMITS.judge(&errors), (State::Breaks, Cause::FalseMisses));
    }

    #[test]
    fn what_is_not_a_number_breaks_and_saturations_degrade() {
        let mut errors = ErrorStats::default();
        errors.decide(true, true);
        errors.err(f64::NAN);
        assert_eq!(LIMITS.judge(&errors), (State::Breaks, Cause::Error));
        let saturated = ErrorStats {
            cases: 1,
            saturations: 1,
            ..ErrorStats::default()
        };
        assert_eq!(
            LIMITS.judge(&saturated),
            (State::Degrades, Cause::Saturations)
        );
    }

    #[test]
    fn an_angle_without_a_bound_is_not_judged() {
        let mut errors = ErrorStats {
            cases: 1,
            ..ErrorStats::default()
        };
        errors.turn(3.0);
        assert_eq!(LIMITS.judge(&errors).0, State::Holds);
    }

    #[test]
    fn without_a_case_nothing_holds() {
        let nothing = LIMITS.judge(&ErrorStats::default());
        assert_eq!(nothing, (State::Breaks, Cause::Refused));
    }
}

mod polygon {
    use octray_stability::sweep::polygon::{Answer, Query, STAR, inside, shipped, square, thesis};

    #[test]
    fn edges_and_vertices_are_inside() {
        let corners = STAR;
        let ask = |point| inside(&Query { corners, point });
        for on in [
            [0.0, 0.0],
            [0.0, -16.0],
            [-16.0, 0.0],
            [16.0, 0.0],
            [10.0, 2.0],
        ] {
            assert_eq!(ask(on), Some(true), "{on:?}");
        }
        assert_eq!(ask([8.0, 8.0]), Some(false));
        assert_eq!(ask([10.0, 2.0 + 4.0 * f64::EPSILON]), None);
    }

    #[test]
    fn on_a_square_of_points_only_the_thesis_is_wrong_and_with_its_remedies_only_on_edges() {
        let answers = square::<f32>();
        let wrong = |form: usize, found: bool| {
            let wrong = |a: &&Answer| a.truth == Some(!found) && a.found[form] == found;
            answers.iter().filter(wrong).count()
        };
        assert_eq!(answers.len(), 69 * 69);
        assert_eq!([wrong(0, true), wrong(0, false)], [0, 0]);
        assert_eq!(wrong(1, true), 0);
        let on_edge = |[x, y]: [f64; 2]| {
            let [x, y] = [x.abs(), y.abs()];
            x + 3.0 * y == 16.0 || 3.0 * x + y == 16.0
        };
        let missed = |a: &&Answer| a.truth == Some(true) && !a.found[1];
        assert!(answers.iter().filter(missed).count() > 0);
        assert!(answers.iter().filter(missed).all(|a| on_edge(a.point)));
        assert!(wrong(2, true) > 0 && wrong(2, false) > wrong(1, false));
    }

    #[test]
    fn far_from_everything_all_forms_agree() {
        let point = [1.0 / 3.0, 0.7];
        let query = Query {
            corners: STAR,
            point,
        };
        assert!(inside(&query) == Some(true) && shipped(query) && thesis(query));
    }
}
