// A program in the fragment of an address: browsers never send it to a server.  `#1.CONTROL.ARGUMENTS.PROGRAM`, each part
// deflated and in base64url; the 1 is the version of this form.

const VERSION = "1";

export interface Shared {
  dialect: string; // empty: detected
  arguments: string;
  text: string;
}

export async function toFragment(shared: Shared): Promise<string> {
  const parts = [shared.dialect, shared.arguments, shared.text].map(packed);
  return [`#${VERSION}`, ...(await Promise.all(parts))].join(".");
}

/** Absent: the fragment is none of ours, or damaged. */
export async function fromFragment(fragment: string): Promise<Shared | undefined> {
  const [version, ...parts] = fragment.slice(1).split(".");
  if (version !== VERSION || parts.length !== 3) return undefined;
  try {
    const [dialect = "", argumentsOfRun = "", text = ""] = await Promise.all(parts.map(unpacked));
    return { dialect, arguments: argumentsOfRun, text };
  } catch {
    return undefined;
  }
}

async function packed(text: string): Promise<string> {
  if (text === "") return "";
  const bytes = await through(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
  const binary = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
  return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

async function unpacked(part: string): Promise<string> {
  if (part === "") return "";
  const bytes = fromBase64(part.replaceAll("-", "+").replaceAll("_", "/"));
  return new TextDecoder("utf-8", { fatal: true }).decode(await through(bytes, new DecompressionStream("deflate-raw")));
}

export function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
}

export async function through(
  bytes: Uint8Array<ArrayBuffer>,
  stream: CompressionStream | DecompressionStream,
): Promise<Uint8Array> {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}
