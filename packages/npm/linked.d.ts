/** The names of all modules: `bounds/hamburger4` and so on. */
export declare const names: string[];

/**
 * The text of modules with all that they import, each once: WGSL without imports. Put a shader of your own behind it.
 * @throws Error for a name that is none of `names`.
 */
export declare function linked(...modules: string[]): string;
