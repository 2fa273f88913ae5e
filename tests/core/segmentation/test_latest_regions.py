import numpy as np
import pytest

from core.segmentation.convexity import ConvexityConfig
from core.segmentation.extraction_state import ExtractedRegion, ExtractionState, painted
from core.segmentation.latest_regions import RevisionConfig, region_image, revised


def state_of(*masks):
    regions = tuple(ExtractedRegion(i + 1, np.argwhere(mask)) for i, mask in enumerate(masks))
    return ExtractionState(regions, len(masks) + 1)


def revised_on(grid, state):
    return revised(state, grid, np.where(grid.free, 1, 0), RevisionConfig(), ConvexityConfig())


def west_of(grid, x):
    mask = grid.free.copy()
    mask[:, round(x / 0.05) :] = False
    return mask


def test_a_region_with_a_wall_in_it_is_cut_and_says_from_what_it_came(two_rooms):
    state = state_of(two_rooms.free)
    found = revised_on(two_rooms, state)
    assert {r.number: r.parents for r in found.state.regions} == {1: (), 2: (1,)}
    assert found.state.next_number == 3
    assert [d.reason for d in found.decisions] == ["cut off: not convex on the latest map"]


def test_regions_that_are_convex_together_are_joined_under_the_larger_one_s_number(square_map):
    west = west_of(square_map, 1.5)
    state = state_of(west, square_map.free & ~west)
    found = revised_on(square_map, state)
    (region,) = found.state.regions
    assert (region.number, region.parents) == (2, (1,))
    assert len(region.cells) == square_map.free.sum()


def test_convex_regions_stay_as_they_are(two_rooms):
    west = west_of(two_rooms, 4.6)
    found = revised_on(two_rooms, state_of(west, two_rooms.free & ~west))
    assert [(r.number, r.parents) for r in found.state.regions] == [(1, ()), (2, ())]
    assert found.decisions == []


def test_a_region_is_what_is_free_of_it_now_in_one_piece(two_rooms):
    state = state_of(np.ones(two_rooms.state.shape, bool))
    labels = region_image(state, two_rooms)
    np.testing.assert_array_equal(labels > 0, two_rooms.free)


@pytest.mark.parametrize(("reach", "share"), [(0.0, 0.5), (1.0, 0.75)])
def test_floor_without_a_region_joins_the_neighbour_within_reach(square_map, reach, share):
    state = state_of(west_of(square_map, 0.5 + 3.5 / 2))
    labels = region_image(state, square_map, reach)
    covered = (labels > 0).sum() / square_map.free.sum()
    assert covered == pytest.approx(0.5 + reach / 3.5, abs=0.01)
    assert covered >= share
    assert painted(state.regions, square_map.geometry).max() == 1
