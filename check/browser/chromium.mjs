// Chromium, and pages in it whose complaints are kept.

import { chromium } from 'playwright-core';

// WebGPU on SwiftShader. A canvas is shown only where Chromium itself draws by it too.
const FLAGS = [
  '--no-sandbox',
  '--disable-quic',
  '--enable-unsafe-webgpu',
  '--enable-features=Vulkan',
  '--use-webgpu-adapter=swiftshader',
  '--use-vulkan=swiftshader',
  '--use-angle=swiftshader',
];

// Wide enough for controls beside the picture, and small: SwiftShader is slow.
const SIZE = [760, 360];

export const launch = () => chromium.launch({ executablePath: '/usr/bin/chromium', args: FLAGS });

/** Opens an address. `page.complaints` are the console's errors and warnings and what no script has caught. */
export async function open(browser, address, { size = SIZE, prepare, isExpected = () => false } = {}) {
  const context = await browser.newContext({ viewport: { width: size[0], height: size[1] } });
  const page = await context.newPage();
  page.complaints = [];
  const complain = (text) => !isExpected(text) && page.complaints.push(text);
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && complain(message.text()));
  page.on('pageerror', (error) => complain(error.message));
  await prepare?.(page);
  await page.goto(address);
  return page;
}

/** Waits for a frame with all that has been asked for. */
export async function drawn(page) {
  await page.waitForFunction(() => !document.getElementById('picture').hasAttribute('aria-busy'), undefined, { timeout: 30_000 });
  const trouble = page.locator('#trouble');
  if (await trouble.isVisible()) throw new Error(`${page.url()} says: ${await trouble.textContent()}`);
}
