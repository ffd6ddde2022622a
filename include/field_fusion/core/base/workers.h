#pragma once
// Threads that share the rows of a picture, the beams of a scan or the particles of a filter.
#include <cstddef>
#include <memory>

namespace field_fusion::core {

/// Kept from one piece of work to the next by who has them.
class Workers {
 public:
  /// `threads`: with the caller's own; 0: as many as cores.
  explicit Workers(int threads);
  ~Workers();
  Workers(Workers&&) noexcept;
  Workers& operator=(Workers&&) noexcept;

  int number() const { return number_; }

  /// Calls job(i, worker) for i of 0 .. count - 1, in any order, and comes back when all are done. What is
  /// computed must not depend on the worker, 0 .. number() - 1, but for scratch memory. What a job throws is
  /// thrown here, once the others have ended.
  template <class Job>
  void share(std::size_t count, const Job& job) {
    share(count, &job, [](const void* of, std::size_t i, int worker) {
      (*static_cast<const Job*>(of))(i, worker);
    });
  }

 private:
  using Call = void (*)(const void* job, std::size_t i, int worker);
  void share(std::size_t count, const void* job, Call call);

  struct Crew;
  int number_;
  std::unique_ptr<Crew> crew_;
};

}  // namespace field_fusion::core
