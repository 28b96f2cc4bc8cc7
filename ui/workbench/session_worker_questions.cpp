// What a session worker asks the operator.
#include <fmt/format.h>

#include <utility>

#include "core/file/counted.hpp"
#include "core/registration/scan_registration.hpp"
#include "core/setting/length_text.hpp"
#include "core/source/scan_source.hpp"
#include "ui/workbench/session_worker.hpp"

namespace nextview {

void SessionWorker::answer(const std::string& text, std::optional<std::uint64_t> number) {
  {
    const std::lock_guard lock(mutex_);
    if (progress_.question.empty() || number.value_or(progress_.question_number) != progress_.question_number) return;
    answer_ = text;
  }
  wake_.notify_all();
}

/// Waits for the answer; what cancels the job gives the last one.
std::string SessionWorker::ask(std::string question, std::vector<std::string> answers,
                               std::shared_ptr<const DoubtfulScan> about, std::vector<std::string> effects) {
  const std::string cautious = answers.back();
  std::unique_lock lock(mutex_);
  progress_.question = std::move(question);
  ++progress_.question_number;
  progress_.answers = std::move(answers);
  progress_.doubtful = std::move(about);
  progress_.effects = std::move(effects);
  answer_.reset();
  lock.unlock();
  news();
  lock.lock();
  wake_.wait(lock, job_.get_token(), [&] { return answer_.has_value(); });
  progress_.question.clear();
  progress_.doubtful.reset();
  progress_.effects.clear();
  return std::exchange(answer_, std::nullopt).value_or(cautious);
}

const std::vector<std::string>& SessionWorker::offer_answers() {
  static const std::vector<std::string> answers = {"Go on", "Begin anew", "Ask later"};
  return answers;
}

void SessionWorker::offer(const EarlierSession& session) {
  const std::string question =
      fmt::format("The session of {} ({}) was not closed. Go on with it?", session.name, session.summary());
  const std::string answer = ask(question, offer_answers(), nullptr,
                                 {"Opens it where it ended", "Opens nothing; it stays kept, and Open recent has it",
                                  "Opens nothing, and asks again at the next start"});
  if (answer == "Go on") runner_.open(session.folder, job_control());
  if (answer == "Begin anew") close_session(session.folder);
}

Session::Verdict SessionWorker::judge(const Acquired& acquired, const std::string& reason) {
  std::vector<std::string> answers = {"Take it", "Reject it"};
  auto scan = std::make_shared<DoubtfulScan>();
  const Scan& taken = acquired.cleaned->scan;  // as it was registered
  scan->reached = taken.hits;
  if (acquired.registration->reliable) {
    answers.insert(answers.begin(), "Correct it");
    scan->corrected = moved(taken, acquired.registration->T_corrected_believed).hits;
  }
  const std::string answer = ask("This scan may not fit: " + reason + ".", answers, std::move(scan));
  if (answer == "Correct it") return Session::Verdict::correct;
  return answer == "Take it" ? Session::Verdict::accept : Session::Verdict::reject;
}

ScannerWishes SessionWorker::scanner_wishes(const request::Connect& request) {
  ScannerWishes wishes{request.command};
  if (request.confirm)
    wishes.confirm = [this](const Pose& from, const Pose& to) {
      const Vector3 p = to.translation();
      return ask(fmt::format("Move the camera by {} to ({:.3f}, {:.3f}, {:.3f}) m?",
                             length_text((p - from.translation()).norm()), p.x(), p.y(), p.z()),
                 {"Move", "Refuse"}) == "Move";
    };
  wishes.log = [this](const std::string& line) { log_.add(LogEntry::Level::note, "Scanner: " + line); };
  return wishes;
}

}  // namespace nextview
