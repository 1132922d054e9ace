// What each method of the protocol brings, by the types that its authors publish; protocol_types_test.py makes a JSON
// Schema of it.
import * as lsp from "vscode-languageserver-protocol";

type All = typeof lsp;
type MethodOf<N> = N extends { readonly method: infer M extends string; readonly type: unknown } ? M : never;
type TypeOf<N> = N extends { readonly type: infer T } ? T : never;
type Said<T> = 0 extends 1 & T ? unknown : [T] extends [void] ? null : T; // the first asks whether it is `any`

type ResultOf<T> = T extends lsp.ProtocolRequestType<any, infer R, any, any, any> ? Said<R>
  : T extends lsp.ProtocolRequestType0<infer R, any, any, any> ? Said<R> : null;
type ParamsOf<T> = T extends lsp.ProtocolNotificationType<infer P, any> ? Said<P>
  : T extends lsp.ProtocolRequestType<infer P, any, any, any, any> ? Said<P> : null;
type ResultsOfAll = { [Name in keyof All as MethodOf<All[Name]>]: ResultOf<TypeOf<All[Name]>> };
type ParamsOfAll = { [Name in keyof All as MethodOf<All[Name]>]: ParamsOf<TypeOf<All[Name]>> };

export interface Results extends ResultsOfAll {}
export interface Params extends ParamsOfAll {
  // Its value has another type for each use.
  "$/progress": {
    token: lsp.ProgressToken;
    value: lsp.WorkDoneProgressBegin | lsp.WorkDoneProgressReport | lsp.WorkDoneProgressEnd;
  };
}
export interface Messages {
  results: Results;
  params: Params;
  envelope: lsp.RequestMessage | lsp.NotificationMessage | lsp.ResponseMessage;
}
