// ClientSession: one client from `initialize` to `exit`.  Internal to the server: what it receives, in which order it
// works, and what it sends.  All members are used by one thread; the lanes hand their results to it as tasks.  Where
// there are no threads, it works in the lanes itself, and attends to what comes whenever such work gives it a turn.
#pragma once

#include "findings/draft/draft.h"
#include "surface/lsp/allowances.h"
#include "surface/lsp/lane.h"
#include "surface/lsp/rpc.h"
#include "surface/lsp/server.h"
#include "surface/lsp/workspace.h"

namespace feedhold::lsp {

class ClientSession {
public:
  ClientSession(EventQueue &queue, MessageWriter &writer, const ServerOptions &options, Worker worker);
  /// Works until the end; returns the exit code.
  int run();

private:
  using Answer = Json (ClientSession::*)(const Json &params);
  using Reaction = void (ClientSession::*)(const Json &params);
  enum class Phase : std::uint8_t { Fresh, Initialized, ShutDown };

  // ---- messages (session.cpp) ----
  bool attend(std::optional<Clock::time_point> until);
  bool workInLanes();
  void attendMeanwhile();
  void receive(const Event &event);
  void receiveRequest(const Json &id, const std::string &method, const Json &params);
  Json answer(const std::string &method, const Json &params);
  void receiveNotification(const std::string &method, const Json &params);
  static const std::map<std::string_view, Answer> &requests();
  static const std::map<std::string_view, Reaction> &notifications();
  void notify(std::string_view method, Json params);
  void ask(std::string_view method, Json params);
  void show(Severity severity, const std::string &message);
  void log(const std::string &message);

  // ---- from the beginning to the end (session_lifecycle.cpp) ----
  Json initialize(const Json &params);
  Json shutDown(const Json &params);
  void initialized(const Json &params);
  void changeSettings(const Json &params);
  void changeFolders(const Json &params);
  void changeFiles(const Json &params);
  void cancelProgress(const Json &params);
  Json capabilities() const;

  // ---- texts and what is found in them (session_documents.cpp) ----
  void open(const Json &params);
  void change(const Json &params);
  void save(const Json &params);
  void close(const Json &params);
  OpenDocument &documentOf(const Json &params);
  void workOnDue();
  std::optional<Clock::time_point> nextDue() const;
  enum class Reason : std::uint8_t { Opened, Typed, Saved };
  void plan(OpenDocument &document, Reason reason);
  void planProofs(OpenDocument &document, Reason reason);
  void planAll();
  void checkQuickly(OpenDocument &document);
  void publish(const OpenDocument &document);
  void complainAbout(const std::vector<PathProblem> &problems);
  Json diagnosticsOf(const OpenDocument &document, std::span<const std::vector<PublishedDiagnostic> *const> lists);
  Json findingsOf(const OpenDocument &document);
  PublishContext publishContext();
  std::string pageOf(std::string_view rule);

  // ---- findings that follow the flow (session_flow.cpp) ----
  struct FlowSubject {
    std::string uri;
    std::uint64_t stamp = 0;
    std::string name;         // of its file in the result
    bool isForOthers = false; // its own text is as it was when it was looked at before
  };
  struct FlowJob {
    std::vector<FlowSubject> subjects;
    FlowScope scope;
  };
  enum class Stage : std::uint8_t { Alone, Last };
  void startFlow(const std::vector<OpenDocument *> &due);
  void submit(FlowJob job);
  void findFlow(const std::vector<FlowSubject> &subjects, const CheckOptions &options, Stage stage);
  void findFlowNow(OpenDocument &document);
  void takeFlow(OpenDocument &document, const CheckResult &result, const FlowSubject &subject, Stage stage);
  void planOthers(const OpenDocument &changed);
  void publishOthers(OpenDocument &document, const CheckResult &result, std::size_t own);
  void publishOther(const std::string &uri);

  // ---- proofs (session_proofs.cpp) ----
  void startProofs(OpenDocument &document);
  void takeProofs(const std::string &uri, std::uint64_t stamp, const std::shared_ptr<ProofsResult> &result);
  /// `work`: of a lane, which the person may cancel.
  void beginProgress(const std::string &token, const std::string &work, const std::string &title);
  void reportProgress(const std::string &token, std::size_t done, std::size_t all); // from any thread
  void endProgress(const std::string &token, const std::string &message);

  // ---- drafted contracts (session_drafts.cpp) ----
  void addDraft(OpenDocument &document, Span asked, Json &actions);
  void startDraft(OpenDocument &document, const std::string &program);
  void takeDraft(const std::string &subject, const DraftResult &result);

  // ---- requests about a document (session_requests.cpp) ----
  Json askFeature(const Feature &feature, const Json &params);
  void followLater(const std::string &uri, const Flow::Programs &programs);
  Json askFeatureOfAll(const Feature &feature, const Json &params);
  Json pullDiagnostics(const Json &params);
  Json colours(const Json &params);

  // ---- what can be done (session_actions.cpp) ----
  Json codeActions(const Json &params);
  void addActions(const PublishedDiagnostic &published, OpenDocument &document, const Places &places, Json &actions);
  Json sidecarEdit(const SidecarClause &clause) const;
  std::optional<Edit> fixAll(OpenDocument &document);
  Json formatting(const Json &params);
  Json execute(const Json &params);
  Json runWitness(const OpenDocument &document, const std::string &id);

  EventQueue &queue_;
  MessageWriter &writer_;
  const ServerOptions &options_;
  Phase phase_ = Phase::Fresh;
  std::optional<int> exitCode_;
  Workspace workspace_;
  Settings settings_;
  bool pullsDiagnostics_ = false;
  bool showsProgress_ = false;
  bool refreshesDiagnostics_ = false;
  bool refreshesLenses_ = false;
  bool refreshesHints_ = false;
  bool registersWatchers_ = false;
  bool createsFiles_ = false; // as part of an edit
  bool appliesEdits_ = false; // that the server asks for
  std::uint64_t lastAsked_ = 0;
  std::map<const Rule *, std::string> pages_;   // URIs; empty: it could not be written
  std::set<std::string> complaints_;            // each is shown once
  std::map<std::string, std::string> progress_; // work of the lane of proofs, by its token
  Lane flowLane_;
  Lane proofLane_;
};

} // namespace feedhold::lsp
