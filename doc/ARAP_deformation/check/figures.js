// Numbers the figures of a page: their links all read "Figure". (CGAL's build has its own way.)
document.addEventListener("DOMContentLoaded", function() {
  document.querySelectorAll('[id^="fig__"]').forEach(function(figure, k) {
    document.querySelectorAll('a[href$="#' + figure.id + '"]').forEach(function(link) {
      link.textContent = "Figure " + (k + 1);
    });
  });
});
