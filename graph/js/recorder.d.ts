import type { Plan, Stage } from './plan.js';

export type { Plan, Stage } from './plan.js';

/** What the host gives: a texture, one per layer (for multisampled ones with several layers), or a buffer. */
export type Import = GPUTexture | GPUTexture[] | GPUBuffer;

export interface RecorderOptions {
  /** A buffer with the usage UNIFORM and a block of `plan.parameters.size` bytes per view; without it there is one for `views` of them. */
  parameters?: GPUBuffer;
  views?: number;
}

export interface HostPass {
  /** `node/pass`. */
  name: string;
  /** The layer that it is drawn for; 0 where it is drawn once. */
  layer: number;
  /** Of a map with planes all those of the layer. */
  targets: GPUTextureView[];
  depth?: GPUTextureView;
  /** Whether the node asks for blending. */
  blend: boolean;
}

export interface Recording {
  /** Where the view's block begins in the parameter buffer. */
  offset?: number;
  /** The layers to make anew: of every map, or for each map its own (others are left out). All, where it is left out. */
  layers?: number[] | Record<string, number[]>;
  /** Draws what the graph leaves to the host, once per layer that is made anew. */
  hostPass?: (pass: HostPass, encoder: GPUCommandEncoder) => void;
}

export interface Recorder {
  readonly device: GPUDevice;
  /** The plan for the imports at hand. */
  readonly plan: Plan;
  readonly parameters: GPUBuffer | undefined;
  /** Takes other imports, of any size that the plan can have. */
  resize(imports: Record<string, Import>): Promise<void>;
  /** The texture or buffer behind an output of the graph. After a resize it is another one. */
  output(name: string): GPUTexture | GPUBuffer;
  /** Records one stage. An error leaves the encoder as it was. */
  record(stage: Stage, encoder: GPUCommandEncoder, recording?: Recording): void;
  /** Gives back the memory of the plan's textures and buffers. */
  destroy(): void;
}

/** Makes everything that a plan needs on a device; sizes follow the imports. */
export function createRecorder(
  device: GPUDevice,
  plan: Plan,
  imports: Record<string, Import>,
  options?: RecorderOptions,
): Promise<Recorder>;
