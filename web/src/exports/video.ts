// The whole run as a film: every picture is drawn from the frames that were computed, none is dropped.
import { ArrayBufferTarget as Mp4Target, Muxer as Mp4Muxer } from "mp4-muxer";
import { ArrayBufferTarget as WebmTarget, Muxer as WebmMuxer } from "webm-muxer";

export interface Film {
  bytes: ArrayBuffer;
  extension: "mp4" | "webm";
}

export interface FilmRequest {
  width: number; // even
  height: number;
  pictures: number;
  rate: number; // pictures a second
  /** Draws picture n, 0 to pictures - 1. */
  draw: (n: number, onto: HTMLCanvasElement) => void;
  progress: (done: number) => void;
  signal: AbortSignal;
}

interface Codec {
  codec: string;
  extension: Film["extension"];
  muxer: "avc" | "V_VP9" | "V_VP8";
}
const kCodecs: Codec[] = [
  { codec: "avc1.640033", extension: "mp4", muxer: "avc" },
  { codec: "avc1.42003e", extension: "mp4", muxer: "avc" },
  { codec: "vp09.00.50.08", extension: "webm", muxer: "V_VP9" },
  { codec: "vp8", extension: "webm", muxer: "V_VP8" },
];

function configuration({ width, height, rate }: FilmRequest, codec: string): VideoEncoderConfig {
  const bitrate = Math.min(20e6, Math.max(2e6, width * height * rate * 0.12));
  return { codec, width, height, framerate: rate, bitrate, latencyMode: "quality" };
}

async function chosenCodec(request: FilmRequest): Promise<Codec | undefined> {
  if (typeof VideoEncoder === "undefined") return undefined;
  for (const codec of kCodecs) {
    const answer = await VideoEncoder.isConfigSupported(configuration(request, codec.codec)).catch(
      () => undefined,
    );
    if (answer?.supported) return codec;
  }
  return undefined;
}

async function encoded(request: FilmRequest, codec: Codec): Promise<Film> {
  const { width, height, pictures, rate, draw, progress, signal } = request;
  const muxer =
    codec.muxer === "avc"
      ? new Mp4Muxer({
          target: new Mp4Target(),
          video: { codec: "avc", width, height, frameRate: rate },
          fastStart: "in-memory",
        })
      : new WebmMuxer({
          target: new WebmTarget(),
          video: { codec: codec.muxer, width, height, frameRate: rate },
        });
  let failure: Error | undefined;
  const encoder = new VideoEncoder({
    output: (chunk, metadata) => muxer.addVideoChunk(chunk, metadata),
    error: (error) => (failure = error),
  });
  encoder.configure(configuration(request, codec.codec));
  const canvas = document.createElement("canvas");
  try {
    for (let n = 0; n < pictures; ++n) {
      signal.throwIfAborted();
      if (failure) throw failure;
      draw(n, canvas);
      const picture = new VideoFrame(canvas, {
        timestamp: Math.round((1e6 * n) / rate),
        duration: Math.round(1e6 / rate),
      });
      encoder.encode(picture, { keyFrame: n % (2 * rate) === 0 });
      picture.close();
      progress(n + 1);
      // The page stays alive, and the encoder keeps up.
      do await new Promise((resolve) => setTimeout(resolve));
      while (encoder.encodeQueueSize > 4 && !failure);
    }
    await encoder.flush();
    if (failure) throw failure;
  } finally {
    if (encoder.state !== "closed") encoder.close();
  }
  muxer.finalize();
  return { bytes: muxer.target.buffer!, extension: codec.extension };
}

/** Without WebCodecs: in real time, by the browser's recorder. */
async function recorded(request: FilmRequest): Promise<Film> {
  const canvas = document.createElement("canvas");
  request.draw(0, canvas);
  const stream = canvas.captureStream(0);
  const track = stream.getVideoTracks()[0] as CanvasCaptureMediaStreamTrack;
  const type = ["video/mp4", "video/webm"].find((kind) => MediaRecorder.isTypeSupported(kind));
  if (!type)
    throw new Error(
      "this browser cannot write a film; export the GLB and use: wilt render leaf.glb -o leaf.mp4",
    );
  const parts: Blob[] = [];
  const recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: 12e6 });
  recorder.ondataavailable = (event) => parts.push(event.data);
  const stopped = new Promise((resolve) => (recorder.onstop = resolve));
  recorder.start();
  try {
    for (let n = 0; n < request.pictures; ++n) {
      request.signal.throwIfAborted();
      request.draw(n, canvas);
      track.requestFrame();
      request.progress(n + 1);
      await new Promise((resolve) => setTimeout(resolve, 1000 / request.rate));
    }
  } finally {
    recorder.stop();
  }
  await stopped;
  return { bytes: await new Blob(parts).arrayBuffer(), extension: type === "video/mp4" ? "mp4" : "webm" };
}

export async function makeFilm(request: FilmRequest): Promise<Film> {
  const codec = await chosenCodec(request);
  return codec ? encoded(request, codec) : recorded(request);
}
