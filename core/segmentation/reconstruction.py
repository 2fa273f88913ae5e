"""Grey-scale reconstruction: what is left of an image when its peaks are cut down and filled again.

After Vincent, "Morphological grayscale reconstruction in image analysis" (IEEE Trans. Image
Processing, 1993): a sweep down, a sweep up, and a queue for what the sweeps have not reached.
scikit-image has the same, but sorts all cells first: with it a five-megapixel plan took 800 MB and
22 s instead of 500 MB and 12 s when both were measured (`tests/benchmarks/large_plan.py`).
"""

from __future__ import annotations

import numba
import numpy as np

from core.geometry import FloatArray


def reconstruction(seed: FloatArray, mask: FloatArray) -> FloatArray:
    """The seed (rows, cols) spread over its eight neighbours again and again, never above the mask.

    Args:
        seed: nowhere above the mask.
        mask: (rows, cols).
    """
    out = np.array(seed, float, order="C")
    _reconstruct(out, np.ascontiguousarray(mask, float))
    return out


@numba.njit(cache=True)
def _reconstruct(out, mask):  # type: ignore[no-untyped-def]
    rows, cols = out.shape
    for r in range(rows):
        for c in range(cols):
            value = out[r, c]
            if c > 0:
                value = max(value, out[r, c - 1])
            if r > 0:
                for k in range(max(c - 1, 0), min(c + 2, cols)):
                    value = max(value, out[r - 1, k])
            out[r, c] = min(value, mask[r, c])
    queue = np.empty(rows * cols, np.int32)
    waits = np.zeros(rows * cols, np.bool_)
    first, count = 0, 0
    for r in range(rows - 1, -1, -1):
        for c in range(cols - 1, -1, -1):
            value = out[r, c]
            if c + 1 < cols:
                value = max(value, out[r, c + 1])
            if r + 1 < rows:
                for k in range(max(c - 1, 0), min(c + 2, cols)):
                    value = max(value, out[r + 1, k])
            value = min(value, mask[r, c])
            out[r, c] = value
            onward = c + 1 < cols and out[r, c + 1] < min(value, mask[r, c + 1])
            if r + 1 < rows:
                for k in range(max(c - 1, 0), min(c + 2, cols)):
                    onward = onward or out[r + 1, k] < min(value, mask[r + 1, k])
            if onward:
                queue[count], waits[r * cols + c] = r * cols + c, True
                count += 1
    while count:
        cell = queue[first]
        first, count = (first + 1) % len(queue), count - 1
        waits[cell] = False
        r, c = cell // cols, cell % cols
        for i in range(max(r - 1, 0), min(r + 2, rows)):
            for k in range(max(c - 1, 0), min(c + 2, cols)):
                value = min(out[r, c], mask[i, k])
                if out[i, k] < value:
                    out[i, k] = value
                    if not waits[i * cols + k]:
                        queue[(first + count) % len(queue)] = i * cols + k
                        waits[i * cols + k] = True
                        count += 1
