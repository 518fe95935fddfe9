// What the scripts of the app find in a browser beside the browser's own: modules by names of the page, and what they share.

declare module "vue" {
  export function toRaw<T>(thing: T): T;
}
declare module "nicegui-scene" {
  export const THREE: any;
  export const OrbitControls: any;
}
declare module "nicegui-plotly" {
  export const Plotly: any;
}
declare module "cardan-scene" {
  export function open(root: HTMLElement, texts: Record<string, any>, emit: (name: string, value?: unknown) => void): any;
}

interface Window {
  cardanView?: any;
  cardanTime?: number | null;
}

/** Methods of a Vue component: `this` has its properties, which Vue puts there. */
type Methods = Record<string, (this: any, ...values: any[]) => any>;
