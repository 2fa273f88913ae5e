import numpy as np

from core.geometry import FloatArray
from core.mapping import GridGeometry, OccupancyGrid
from core.segmentation.autonomous import AutonomousConfig, extract, finish
from core.segmentation.extraction_state import ExtractionState, lattice_corner, painted
from core.segmentation.inheritance import with_region
from core.segmentation.latest_regions import region_image
from core.segmentation.moment import Moment

LEFT, RIGHT = np.array([2.5, 2.0, 0.0]), np.array([7.0, 2.0, 0.0])


def seen(grid: OccupancyGrid, pose: FloatArray, t: float) -> Moment:
    """A moment at which the robot knows the whole map."""
    return Moment(t, t, pose, grid, np.zeros(grid.geometry.shape))


def test_the_room_that_the_robot_has_left_is_extracted(two_rooms):
    grid = two_rooms
    state = extract(ExtractionState(), seen(grid, RIGHT, 10.0))
    assert len(state.regions) == 1
    cells = state.regions[0].cells
    assert cells[:, 1].max() * 0.05 < 5.2


def test_nothing_is_extracted_while_the_robot_is_near(two_rooms):
    state = extract(ExtractionState(), seen(two_rooms, np.array([4.6, 2.1, 0.0]), 10.0))
    assert not any(e["accepted"] for e in state.history if e["event"] == "extract")


def test_an_extracted_region_is_left_alone_until_the_robot_is_back(two_rooms):
    grid = two_rooms
    state = extract(ExtractionState(), seen(grid, RIGHT, 10.0))
    again = extract(state, seen(grid, RIGHT, 20.0))
    assert again.regions == state.regions
    back = extract(again, seen(grid, LEFT, 30.0))
    assert any("back in region 1" in entry.get("said", "") for entry in back.history)


def test_a_region_that_is_extracted_anew_keeps_its_number(two_rooms):
    grid = two_rooms
    state = extract(ExtractionState(), seen(grid, RIGHT, 10.0))
    number = state.regions[0].number
    state = extract(state, seen(grid, LEFT, 20.0))
    state = extract(state, seen(grid, RIGHT, 30.0))
    left = painted(state.regions, grid.geometry)[tuple(grid.geometry.cell_of(LEFT[:2]))]
    assert left == number


def test_at_the_end_all_floor_has_a_region(two_rooms):
    grid = two_rooms
    state = finish(extract(ExtractionState(), seen(grid, RIGHT, 10.0)), seen(grid, RIGHT, 20.0))
    regions = region_image(state, grid)
    assert (regions[grid.free] > 0).mean() > 0.99
    assert len(np.unique(regions[regions > 0])) == 2


def test_regions_stay_where_they_are_when_the_grid_grows(two_rooms):
    grid = two_rooms
    state = extract(ExtractionState(), seen(grid, RIGHT, 10.0))
    wider = GridGeometry(0.05, (-1.0, -0.5, 0.0), tuple(n + 40 for n in grid.state.shape))
    bigger = OccupancyGrid(wider, np.pad(grid.state, ((10, 30), (20, 20))))
    before = grid.geometry.world_of(np.argwhere(painted(state.regions, grid.geometry) > 0))
    after = wider.world_of(np.argwhere(painted(state.regions, bigger.geometry) > 0))
    assert np.allclose(before, after)
    assert lattice_corner(wider).tolist() == [-10, -20]


def test_the_end_says_what_it_held_the_regions_against_and_whom_they_came_from(two_rooms):
    grid, config = two_rooms, AutonomousConfig()
    state, whole = with_region(ExtractionState(), grid.free, grid.geometry)
    state = finish(state, seen(grid, RIGHT, 20.0), config)
    (*_, last), cut = (
        [e for e in state.history if e["event"] == event] for event in ("step", "extract")
    )
    assert last["thresholds"]["hidden_pairs"] == config.revision.grouping.most_hidden
    assert [(e["came_from"], e["accepted"]) for e in cut] == [([whole.number], True)]
    assert cut[0]["region"] == 2


def test_the_same_end_comes_to_the_same_regions(two_rooms):
    ends = [finish(ExtractionState(), seen(two_rooms, RIGHT, 20.0)) for _ in range(2)]
    images = [region_image(end, two_rooms) for end in ends]
    np.testing.assert_array_equal(*images)
