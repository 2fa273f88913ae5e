// A picture of the 3D view as it is, with its background, as a PNG to keep.
import { frameCanvas } from "./view3d.js";
import { theme } from "./theme.js";

const SKIES = { light: ["#ffffff", "#e4eaf4"], dark: ["#252c3a", "#12161f"] };

export async function saveScreenshot(name) {
  const canvas = frameCanvas();
  if (!canvas) throw new Error("There is no 3D view to take a picture of.");
  const picture = document.createElement("canvas");
  picture.width = canvas.width;
  picture.height = canvas.height;
  const context = picture.getContext("2d");
  const [inner, outer] = SKIES[theme()];
  const sky = context.createRadialGradient(
    picture.width / 2, picture.height * 0.42, 0, picture.width / 2, picture.height * 0.42, picture.width * 0.6,
  );
  sky.addColorStop(0, inner);
  sky.addColorStop(1, outer);
  context.fillStyle = sky;
  context.fillRect(0, 0, picture.width, picture.height);
  context.drawImage(canvas, 0, 0);
  const blob = await new Promise((resolve) => picture.toBlob(resolve, "image/png"));
  if (!blob) throw new Error("The browser could not make the picture.");
  const url = URL.createObjectURL(blob);
  const anchor = document.createElement("a");
  anchor.href = url;
  anchor.download = `${name.replace(/[^\p{L}\p{N} _-]+/gu, "").trim() || "map"}.png`;
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
