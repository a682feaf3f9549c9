// The data of a plan, as `moment-shadows export-plan` writes it.

/** A compiled graph. Numbers that stand for resources, shaders and the like are indices into the plan. */
export interface Plan {
  version: 3;
  device: { features: GPUFeatureName[]; wgpu_features: string[]; limits: Record<string, number> };
  /** The index of the bind group that all passes use. */
  bind_group: number;
  shaders: string[];
  passes: PlannedPass[];
  resources: PlannedResource[];
  memory: { label: string; desc: ResourceDesc; usage: Usage[] }[];
  imports: { name: string; resource: number }[];
  outputs: { name: string; resource: number }[];
  parameters: ParameterLayout;
}

export type Stage = 'after_shadow_maps' | 'after_main_pass';
export type Usage = 'COPY_SRC' | 'TEXTURE_BINDING' | 'STORAGE_BINDING' | 'RENDER_ATTACHMENT' | 'STORAGE';

export interface PlannedPass {
  node: string;
  label: string;
  stage: Stage;
  shader: number | null;
  entry_point: string;
  vertex_entry_point: string | null;
  constants: Record<string, number>;
  visibility: 'COMPUTE' | 'FRAGMENT' | null;
  bindings: PlannedBinding[];
  dynamic_offsets: { offset: number; stride: number }[];
  work: PlannedWork;
  reads: PlannedUse[];
  writes: PlannedUse[];
  after: number[];
  after_in_memory: number[];
  layers: number;
  each_layer: boolean;
  /** The import or resource whose layers it follows. */
  map: string;
  bytes_read: number;
  bytes_written: number;
}

export interface PlannedUse {
  resource: number;
  level?: number;
  plane?: number;
}

export interface Part {
  level: number;
  plane: number;
}

export interface PlannedBinding {
  binding: number;
  name: string;
  layout: Omit<GPUBindGroupLayoutEntry, 'binding' | 'visibility'>;
  resource:
    | { parameters: { block: number } }
    | { regions: { table: number } }
    | { texture: { resource: number; part?: Part } }
    | { storage_texture: { resource: number; part: Part } }
    | { buffer: { resource: number } }
    | { sampler: GPUSamplerDescriptor };
}

export type PlannedWork =
  | { compute: { workgroups: [number, number]; covers: number; level: number; texels_per_workgroup: [number, number]; regions?: number } }
  | { fullscreen: { target: number; part: Part; keeps: boolean } }
  | { host: { targets: number[]; planes?: number; blend: boolean; depth: number | null } };

export interface PlannedResource {
  name: string;
  desc: ResourceDesc;
  usage: Usage[];
  extent: { import: number; per: [number, number] } | null;
  lives: 'frame' | 'layers_left_out' | 'always';
  home: { import: number } | { memory: number };
}

export type ResourceDesc = { texture: TextureDesc } | { buffer: { size: number } };

export interface TextureDesc {
  format: GPUTextureFormat;
  size: [number, number];
  layers: number;
  mips: number;
  regions: number;
  planes: number;
  samples: number;
  encoding?: unknown;
  /** The standard deviation of the filter that a map has been through, in texels; 0 where it is left out. */
  deviation?: number;
  /** The same of a filter with a kernel for each region, in scene units. */
  width?: number;
  /** What a map's depths are fitted to, as `node.slot`; the host's range where it is left out. */
  range?: string;
}

export interface ParameterLayout {
  /** Bytes of one view's block. */
  size: number;
  blocks: PlannedParameters[];
  regions: PlannedRegions[];
}

export interface PlannedParameters {
  node: string;
  name: string;
  offset: number;
  size: number;
  elements: number;
  stride: number;
  count: number;
  initial: number[];
  fields: PlannedField[];
}

export interface PlannedField {
  name: string;
  type: string;
  offset: number;
  count: number;
  stride: number;
}

export interface PlannedRegions {
  map: string;
  offset: number;
  stride: number;
  layers: number;
  capacity: number;
  extent: [number, number];
  smallest: number;
  initial: number[];
}
