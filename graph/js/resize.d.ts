import type { Plan } from './plan.js';

/** The plan for imports with these widths and heights; throws where the graph has to be compiled for them. */
export function resized(plan: Plan, sizes: Record<string, [number, number]>, most?: number): Plan;

/** Workgroups in x and y that cover a map, or any of its regions that do not overlap. */
export function workgroupsFor(
  size: [number, number],
  regions: number,
  texelsPerWorkgroup: [number, number],
  most: number,
): [number, number];
