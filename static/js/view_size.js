// Tells a 3D view how large its frame is: it learns of a new size late from viser, or not at all.

/** Tells the size (CSS pixels) whenever it changes; returns a function that tells it now. */
export function watchSize(frame, tell) {
  const send = () => {
    const { clientWidth: width, clientHeight: height } = frame;
    if (width && height) tell({ type: "viewport", width, height });
  };
  new ResizeObserver(send).observe(frame);
  return send;
}
