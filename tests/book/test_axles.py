import array_api_strict as strict
import numpy as np
import pytest

from cardan.book.axles import cascade_ratios, cascade_shares, wind_up


def by_gears(ratio):
    """Balance every wheel of the cascade: carriers, their two outputs, power at speeds that differ."""
    k = len(ratio) + 1
    shares, come = [], 1.0
    for i in ratio:
        # Outputs of a differential, its carrier held, turn as 1 : -i; at rest of the sum ω_1 + i ω_2 = (1 + i) ω_c
        # power in = power out for any speeds gives T_1 : T_2 : T_c.
        speeds = np.asarray([[1.0, 0.0], [0.0, 1.0]])
        carrier = speeds @ [1 / (1 + i), i / (1 + i)]
        axle, on = np.linalg.solve(speeds, come * carrier)
        shares.append(axle)
        come = on
    assert len(shares) == k - 1
    return [*shares, come]


@pytest.mark.parametrize("count", [2, 3, 5, 8])
def test_equal_axles_need_falling_whole_ratios(count):
    ratio = cascade_ratios(np.ones(count))
    assert np.allclose(ratio, np.arange(count - 1, 0, -1), rtol=1e-15)
    assert np.allclose(by_gears(ratio), 1 / count, rtol=1e-14)


def test_ratios_and_shares_undo_one_another():
    share = np.random.default_rng(5).uniform(0.1, 2.0, (4, 6))
    share /= share.sum(axis=-1, keepdims=True)
    assert np.allclose(cascade_shares(cascade_ratios(share)), share, rtol=1e-14)
    assert np.allclose(by_gears(cascade_ratios(share[0])), share[0], rtol=1e-14)
    assert list(cascade_shares(np.empty(0))) == [1.0]
    assert cascade_ratios([1.0]).shape == (0,)


def test_wind_up_is_the_difference_of_what_the_wheels_turn():
    small, large, way = 0.31, 0.33, 140.0
    found = wind_up(small, large, stiffness=9e3, grip=2e3)
    assert float(found.rate * way) == pytest.approx(way / small - way / large, rel=1e-13)
    assert float(found.slip) == pytest.approx((large - small) / (0.5 * (large + small)), rel=1e-15)
    assert float(found.torque_rate * found.distance) == pytest.approx(2e3, rel=1e-15)
    assert 9e3 * float(found.rate * found.distance) == pytest.approx(2e3, rel=1e-14)


def test_equal_wheels_never_slip_and_what_is_not_given_stays_open():
    found = wind_up(0.5, [0.5, 0.51], stiffness=9e3, grip=2e3)
    assert found.rate[0] == 0.0
    assert found.distance[0] == np.inf
    bare = wind_up(0.5, [0.5, 0.51])
    assert np.isnan(bare.torque_rate).all()
    assert np.isnan(bare.distance).all()
    assert np.isnan(wind_up(0.5, 0.51, stiffness=1.0).distance)


def test_any_array_library_computes_them():
    share = strict.asarray([0.4, 0.3, 0.3])
    assert np.allclose(np.asarray(cascade_ratios(share)), [1.5, 1.0], rtol=1e-15)
    assert np.allclose(np.asarray(cascade_shares(cascade_ratios(share))), [0.4, 0.3, 0.3], rtol=1e-15)
    assert float(wind_up(strict.asarray(0.5), strict.asarray(0.51)).slip) > 0
